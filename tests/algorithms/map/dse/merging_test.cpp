// The merged segment and its cost on pairs that can be computed by hand.
#include "algorithms/map/dse/merging.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"
#include "tests/support/matchers.hpp"

namespace scanbench::mapping::dse {
namespace {

using support::SegmentNear;

const Vec2 kX(1, 0);

TEST(Merging, TheLineLiesWhereDistanceTimesLengthIsEqual) {
  // Lengths 2 and 1, offsets 0 and 0.3: d1 = 0.1 and d2 = 0.2, since 0.1 * 2 = 0.2 * 1.
  const auto child = merged({{0, 0}, {2, 0}}, {{0.5, 0.3}, {1.5, 0.3}}, kX, {});
  ASSERT_TRUE(child);
  EXPECT_THAT(child->segment, SegmentNear(Segment{{0, 0.1}, {2, 0.1}}, 1e-12));
}

TEST(Merging, TheCostOfParallelSegmentsIsWhatThePaperSumsUp) {
  // a1 = a2 = a12 = 0; D1 = 0.1 + 0.1, D2 = 0.2 + 0.2; hull 2, projections 2 + 1: r = 2/3.
  const Segment l1{{0, 0}, {2, 0}}, l2{{0.5, 0.3}, {1.5, 0.3}};
  const double r = 2.0 / 3.0;
  EXPECT_NEAR(merged(l1, l2, kX, {.k = 9})->cost, r * (2 * 0.2 + 1 * 0.4) / 10, 1e-12);
  EXPECT_NEAR(merged(l1, l2, kX, {.form = CostForm::ratio_of_distances, .k = 9})->cost,
              (2 * r * 0.2 + 1 * r * 0.4) / 10, 1e-12);
  EXPECT_NEAR(merged(l1, l2, kX, {.form = CostForm::ratio_added, .k = 9})->cost, (2 * (r + 0.2) + 1 * (r + 0.4)) / 10,
              1e-12);
}

TEST(Merging, TheCostOfACrossingPairCountsItsAngles) {
  // Both of length 1 through the origin, at 0 and 60 degrees, towards 0: a1 = 0, a2 = a12 = 60 degrees, cos 1/2; D1 =
  // 0, D2 = sin 60; hull 1, projections 1 + 1/2.
  const Segment l1{{-0.5, 0}, {0.5, 0}};
  const Segment l2{0.5 * Vec2(-0.5, -std::sqrt(0.75)), 0.5 * Vec2(0.5, std::sqrt(0.75))};
  const double expected = (1 / 1.5) * (kPi / 3 + std::sqrt(0.75)) / (1 + 100 * 0.5);
  const auto child = merged(l1, l2, kX, {});
  ASSERT_TRUE(child);
  EXPECT_NEAR(child->cost, expected, 1e-12);
  EXPECT_THAT(child->segment, SegmentNear(l1, 1e-12));
}

TEST(Merging, CollinearSegmentsCostNothingAndAGapIsBridgedOnlyUpToItsLimit) {
  const Segment l1{{0, 1}, {1, 1}}, l2{{1.2, 1}, {2, 1}};
  const auto child = merged(l1, l2, kX, {});
  ASSERT_TRUE(child);
  EXPECT_NEAR(child->cost, 0.0, 1e-12);
  EXPECT_THAT(child->segment, SegmentNear(Segment{{0, 1}, {2, 1}}, 1e-12));
  EXPECT_FALSE(merged(l1, l2, kX, {.max_gap_m = 0.19}));
  EXPECT_TRUE(merged(l1, {{51, 1}, {52, 1}}, kX, {.max_gap_m = std::numeric_limits<double>::infinity()}));
}

TEST(Merging, AnEndFartherFromTheLineThanTheLimitIsNotMerged) {
  const Segment l1{{0, 0}, {2, 0}}, l2{{0.5, 0.3}, {1.5, 0.3}};  // 0.1 and 0.2 from the line
  EXPECT_TRUE(merged(l1, l2, kX, {.max_apart_m = 0.201}));
  EXPECT_FALSE(merged(l1, l2, kX, {.max_apart_m = 0.199}));
}

TEST(Merging, WithEvidenceAsWeightsTheLineLiesWhereThePointsAreOnAverage) {
  const auto child = merged({{0, 0}, {1, 0}}, {{0, 0.4}, {1, 0.4}}, kX, {}, {.first = 300, .second = 100});
  ASSERT_TRUE(child);
  EXPECT_NEAR(child->segment.a.y(), 0.1, 1e-12);
}

TEST(Merging, SegmentsPerpendicularToTheDirectionHaveNoChild) {
  EXPECT_FALSE(merged({{0, 0}, {0, 1}}, {{0.1, 0}, {0.1, 1}}, kX, {}));
  EXPECT_FALSE(merged({{0, 0}, {0.05, 1}}, {{0.1, 0}, {0.1, 1}}, kX, {}));  // projections: 5 cm of 2 m
}

TEST(Merging, SegmentsWithoutLengthHaveNoChild) {
  EXPECT_FALSE(merged({{1, 1}, {1, 1}}, {{1, 1}, {1, 1}}, kX, {}));
}

TEST(Merging, TheChildHasItsParentsFreeSide) {
  const auto child = merged({{2, 0}, {0, 0}}, {{2, 0.1}, {1, 0.1}}, kX, {});
  ASSERT_TRUE(child);
  EXPECT_LT(child->segment.direction().x(), 0);
}

TEST(Merging, TheCheapestDirectionIsTaken) {
  const Segment l1{{0, 0}, {0, 2}}, l2{{0.02, 0}, {0.02, 2}};
  const std::vector<Vec2> directions{kX, {std::sqrt(0.5), std::sqrt(0.5)}, {0, 1}};
  const auto child = cheapest_child(l1, l2, directions, {});
  ASSERT_TRUE(child);
  EXPECT_EQ(child->direction, 2u);
  EXPECT_FALSE(cheapest_child(l1, l2, {}, {}));
}

/// A pair of segments of up to 2 m near each other.
std::pair<Segment, Segment> random_pair(std::uint32_t k) {
  CounterRng rng(11, RngStream::pose, k);
  const auto point = [&] { return Vec2(2 * rng.uniform(), 2 * rng.uniform()); };
  const Vec2 a = point(), b = point(), c = point(), d = point();
  return {{a, b}, {c, d}};
}

TEST(Merging, TheCostIsSymmetricAndIndependentOfTheFrameAndOfTheEnds) {
  const MergeRule rule{.max_gap_m = 10};
  const Pose2 motion(30, -20, 0.7);
  int pairs = 0;
  for (std::uint32_t k = 0; k < 200; ++k) {
    const auto [l1, l2] = random_pair(k);
    const Vec2 ad(std::cos(0.1 * k), std::sin(0.1 * k));
    const auto child = merged(l1, l2, ad, rule);
    if (!child) continue;
    ++pairs;
    EXPECT_NEAR(merged(l2, l1, ad, rule)->cost, child->cost, 1e-12);
    EXPECT_NEAR(merged({l1.b, l1.a}, l2, ad, rule)->cost, child->cost, 1e-12);
    const auto moved = merged(motion * l1, motion * l2, motion.rotate(ad), rule);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(moved->cost, child->cost, 1e-10);
    EXPECT_THAT(moved->segment, SegmentNear(motion * child->segment, 1e-9));
    EXPECT_NEAR(std::abs(cross(child->segment.direction(), ad)), 0.0, 1e-9);
  }
  EXPECT_GT(pairs, 150);
}

TEST(Merging, TheCostGrowsWithTheOffsetOfAParallelSegmentAndWithTheGap) {
  double last = -1.0;
  for (double offset = 0.0; offset < 1.0; offset += 0.05) {
    const double cost = merged({{0, 0}, {2, 0}}, {{0.5, offset}, {1.5, offset}}, kX, {})->cost;
    EXPECT_GT(cost, last);
    last = cost;
  }
  last = -1.0;
  for (double gap = 0.0; gap < 2.0; gap += 0.1) {
    const double cost = merged({{0, 0}, {2, 0}}, {{2 + gap, 0.1}, {3 + gap, 0.1}}, kX, {.max_gap_m = 5})->cost;
    EXPECT_GT(cost, last);
    last = cost;
  }
}

}  // namespace
}  // namespace scanbench::mapping::dse
