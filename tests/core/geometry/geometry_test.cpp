// Angles, segments and lines: identities on the circle and in degenerate cases.
#include "core/geometry/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace scanbench {
namespace {

TEST(WrapAngle, MapsToTheHalfOpenTurn) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3 * kPi), kPi, 1e-15);
  EXPECT_NEAR(wrap_angle(7.0), 7.0 - kTwoPi, 1e-15);
  EXPECT_TRUE(std::isnan(wrap_angle(INFINITY)));
}

TEST(DirectionModPi, IsTheSameForAVectorAndItsOpposite) {
  CounterRng rng(1, RngStream::pose);
  for (int i = 0; i < 1000; ++i) {
    const double a = 20.0 * (rng.uniform() - 0.5);
    const double d = direction_mod_pi(a);
    EXPECT_GE(d, 0.0);
    EXPECT_LT(d, kPi);
    EXPECT_NEAR(wrap_direction(d - direction_mod_pi(a + kPi)), 0.0, 1e-14);
  }
}

TEST(Canonical, HasNonNegativeRhoAndOneFormThroughTheOrigin) {
  const PolarLine line = canonical(-2.0, 0.5);
  EXPECT_EQ(line.rho, 2.0);
  EXPECT_NEAR(line.alpha, 0.5 - kPi, 1e-15);
  EXPECT_NEAR(canonical(0.0, -0.25).alpha, kPi - 0.25, 1e-15);
}

TEST(LineThrough, ContainsBothPointsAndHasTheOriginOnItsPositiveSide) {
  CounterRng rng(2, RngStream::pose);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 a(rng.normal(), rng.normal());
    const Vec2 b(rng.normal(), rng.normal());
    const PolarLine line = line_through(a, b);
    EXPECT_GE(line.rho, 0.0);
    EXPECT_NEAR(line.signed_distance(a), 0.0, 1e-14);
    EXPECT_NEAR(line.signed_distance(b), 0.0, 1e-14);
    EXPECT_NEAR(line.signed_distance(Vec2::Zero()), line.rho, 0.0);
  }
}

TEST(LineDifference, TreatsALineAndItsOppositeFormAsOne) {
  const auto d = line_difference({0.001, 0.3}, {0.001, wrap_angle(0.3 + kPi)});
  EXPECT_NEAR(d.rho, 0.002, 1e-15);
  EXPECT_NEAR(d.alpha, 0.0, 1e-15);
}

TEST(LineDifference, IsSmallAcrossTheSeamOfTheCircle) {
  const auto d = line_difference({3.0, kPi - 0.01}, {3.1, -kPi + 0.02});
  EXPECT_NEAR(d.rho, 0.1, 1e-14);
  EXPECT_NEAR(d.alpha, 0.03, 1e-14);
}

TEST(LineDifference, IsSymmetricAndNeverMoreThanARightAngle) {
  CounterRng rng(3, RngStream::pose);
  for (int i = 0; i < 1000; ++i) {
    const PolarLine a{5 * rng.uniform(), kPi * (2 * rng.uniform() - 1)};
    const PolarLine b{5 * rng.uniform(), kPi * (2 * rng.uniform() - 1)};
    const auto ab = line_difference(a, b);
    const auto ba = line_difference(b, a);
    EXPECT_LE(ab.alpha, kPi / 2 + 1e-15);
    EXPECT_NEAR(ab.alpha, ba.alpha, 1e-14);
    EXPECT_NEAR(ab.rho, ba.rho, 1e-14);
  }
}

TEST(DistanceToASegment, IsToItsEndsBeyondThemAndToItsLineBetween) {
  const Segment s{{0, 0}, {2, 0}};
  EXPECT_DOUBLE_EQ(distance({1, 3}, s), 3.0);
  EXPECT_DOUBLE_EQ(distance({5, 4}, s), 5.0);
  EXPECT_DOUBLE_EQ(distance({-3, -4}, s), 5.0);
  EXPECT_DOUBLE_EQ(distance({3, 4}, Segment{{0, 0}, {0, 0}}), 5.0);
}

TEST(AngleBetween, IgnoresTheDirectionsOfTheSegments) {
  const Segment s{{1, 1}, {3, 1}};
  for (const double angle : {0.0, 0.4, kPi / 2}) {
    const Vec2 d(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(angle_between(s, {{5, 5}, Vec2(5, 5) + d}), angle, 1e-15);
    EXPECT_NEAR(angle_between({Vec2(5, 5) + d, {5, 5}}, s), angle, 1e-15);
  }
}

TEST(SegmentDirection, OfASegmentWithoutLengthIsZero) {
  EXPECT_EQ(Segment{}.direction().norm(), 0.0);
}

TEST(SeenFromOrigin, HasTheOriginOnItsLeftInEitherOrder) {
  for (const auto& [p, q] : {std::pair(Vec2(2, -1), Vec2(2, 1)), std::pair(Vec2(-3, 0.5), Vec2(1, 2))})
    for (const Segment& s : {seen_from_origin(p, q), seen_from_origin(q, p)})
      EXPECT_GT(cross(s.b - s.a, Vec2(-s.a)), 0.0);
}

}  // namespace
}  // namespace scanbench
