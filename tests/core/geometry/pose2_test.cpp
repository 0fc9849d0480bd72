// Rigid motions: group laws, the exponential map, lines under motion.
#include "core/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace scanbench {
namespace {

Pose2 random_pose(CounterRng& rng) {
  return {10 * rng.normal(), 10 * rng.normal(), kTwoPi * rng.uniform()};
}

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR((a.translation() - b.translation()).norm(), 0.0, tolerance);
  EXPECT_NEAR(wrap_angle(a.yaw() - b.yaw()), 0.0, tolerance);
}

TEST(Pose2, ComposesAsItsActionOnPointsDoes) {
  CounterRng rng(1, RngStream::pose);
  for (int i = 0; i < 200; ++i) {
    const Pose2 a = random_pose(rng);
    const Pose2 b = random_pose(rng);
    const Vec2 p(rng.normal(), rng.normal());
    EXPECT_NEAR(((a * b) * p - a * (b * p)).norm(), 0.0, 1e-13);
    expect_same(a * a.inverse(), Pose2(), 1e-13);
  }
}

TEST(Pose2, ExponentialAndLogarithmAreInverse) {
  CounterRng rng(2, RngStream::pose);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d twist(rng.normal(), rng.normal(), 6.2 * (rng.uniform() - 0.5));
    EXPECT_NEAR((Pose2::exp(twist).log() - twist).norm(), 0.0, 1e-11);
  }
  const Eigen::Vector3d small(0.3, -0.2, 1e-7);
  EXPECT_NEAR((Pose2::exp(small).log() - small).norm(), 0.0, 1e-15);
}

TEST(Pose2, HalfATwistTwiceIsTheWholeTwist) {
  const Eigen::Vector3d twist(1.0, 0.5, 2.0);
  const Pose2 half = Pose2::exp(0.5 * twist);
  expect_same(half * half, Pose2::exp(twist), 1e-14);
}

TEST(Pose2, StaysARotationOverALongChain) {
  const Pose2 step(0.01, 0.0, 0.1);
  Pose2 pose;
  for (int i = 0; i < 100000; ++i) pose = pose * step;
  EXPECT_NEAR(pose.cos() * pose.cos() + pose.sin() * pose.sin(), 1.0, 1e-14);
}

TEST(Pose2, FacingADirectionNeedsNoAngle) {
  const Pose2 pose = Pose2::facing({1, 2}, {3, 4});
  EXPECT_EQ(pose.cos(), 0.6);
  EXPECT_EQ(pose.sin(), 0.8);
}

TEST(TransformedLine, HoldsTheTransformedPoints) {
  CounterRng rng(3, RngStream::pose);
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose = random_pose(rng);
    const Vec2 a(rng.normal(), rng.normal());
    const Vec2 b(rng.normal(), rng.normal());
    const PolarLine moved = transform(pose, line_through(a, b));
    EXPECT_NEAR(moved.signed_distance(pose * a), 0.0, 1e-13);
    EXPECT_NEAR(moved.signed_distance(pose * b), 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace scanbench
