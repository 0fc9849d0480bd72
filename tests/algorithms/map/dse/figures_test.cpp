// Figures 2 to 6 of Lakaemper, Latecki & Wolter 2005 as scenes whose results can be computed by hand: vertex insertion
// (figure 5), pairing at several thresholds (figure 6), children that follow the main directions (figures 2 and 3), the
// tent that simplification keeps (figure 3).
//
// The paper prints no coordinates. The scene of figures 5 and 6: a straight map with a triangular tent, sides at 62
// degrees, in 10 x 4 units, and a straight scan half a unit above it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/map/dse/pairing.hpp"
#include "algorithms/map/dse/simplification.hpp"
#include "algorithms/map/dse/vertex_insertion.hpp"
#include "tests/support/matchers.hpp"

namespace scanbench::mapping::dse {
namespace {

using support::SegmentNear;

const double kSlope = std::tan(radians(62));
constexpr double kHeight = 0.5;  // of the scan above the map

Stroke stroke(const Vec2& a, const Vec2& b) {
  return {.segment = {a, b}, .created = 0, .members = 1, .points = 100};
}

std::vector<Stroke> tent_map() {
  return {stroke({0, 0}, {4, 0}), stroke({4, 0}, {5, kSlope}), stroke({5, kSlope}, {6, 0}), stroke({6, 0}, {10, 0})};
}

/// Main directions of 0, 62 and -62 degrees.
std::vector<Vec2> tent_directions() {
  std::vector<Vec2> directions;
  for (const double deg : {0.0, 62.0, -62.0}) directions.emplace_back(std::cos(radians(deg)), std::sin(radians(deg)));
  return directions;
}

std::vector<Stroke> straight_scan() {
  return with_vertices(std::vector{stroke({0, kHeight}, {10, kHeight})}, ends_of(tent_map()), {.reach_m = 2.0});
}

TEST(Figure5, TheScanIsCutWhereTheMapsEndsProjectTo) {
  const std::vector<Stroke> pieces = straight_scan();
  ASSERT_EQ(pieces.size(), 4u);
  const double x[] = {0, 4, 5, 6, 10};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_THAT(pieces[k].segment, SegmentNear(Segment{{x[k], kHeight}, {x[k + 1], kHeight}}, 1e-12));
    EXPECT_NEAR(pieces[k].points, 10 * (x[k + 1] - x[k]), 1e-9);  // evidence by length
  }
}

TEST(Figure5, NoVertexForAnEndBeyondTheReachOrNearAnother) {
  const std::vector whole{stroke({0, 0}, {10, 0})};
  const std::vector<Vec2> ends{{3, 1.0}, {5, 0.1}, {5.03, 0.1}, {0.02, 0.1}, {12, 0}};
  const std::vector<Stroke> pieces = with_vertices(whole, ends, {.reach_m = 0.2, .apart_m = 0.05});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_THAT(pieces[0].segment, SegmentNear(Segment{{0, 0}, {5, 0}}, 1e-12));
  EXPECT_THAT(pieces[1].segment, SegmentNear(Segment{{5, 0}, {10, 0}}, 1e-12));
}

TEST(Figure5, AnEndCutsTheStrokeThatItIsClosestTo) {
  const std::vector two{stroke({0, 0}, {10, 0}), stroke({0, 0.3}, {10, 0.3})};
  const std::vector<Stroke> pieces = with_vertices(two, std::vector<Vec2>{{4, 0.2}}, {.reach_m = 1.0});
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_THAT(pieces[0].segment, SegmentNear(two[0].segment, 0.0));
}

/// The costs of the scene's two kinds of pairs by the paper's formula, worked out with the numbers of the scene.
double flat_cost() {
  // Two parallel pieces of length 4, each half a unit / 2 from the line: D = 0.25 + 0.25, r = 4 / 8.
  return 0.5 * (4 * kHeight + 4 * kHeight) / 101;
}
double touch_cost() {
  // A flat piece of the map, length 4, and the neighbouring piece of the scan, length 1, half a unit across: a tenth
  // and four tenths from the line, D = 0.2 and 0.8; the hull is as long as both: r = 1.
  return (4 * 0.2 + 1 * 0.8) / 101;
}
double side_cost() {
  // A side of the tent (length 1 / cos 62) and the piece of length 1 below its middle, along 62 degrees.
  const double a = radians(62), length = 1 / std::cos(a);
  const double apart = (0.5 * kSlope - kHeight) * std::cos(a);  // of the midpoints, across the direction
  const double d1 = apart * 1 / (length + 1), d2 = apart - d1;
  const double big_d1 = 2 * d1;
  const double big_d2 = std::abs(d2 + 0.5 * std::sin(a)) + std::abs(d2 - 0.5 * std::sin(a));
  const double r = length / (length + std::cos(a));  // the piece projects into the side
  return r * (length * big_d1 + 1 * (a + big_d2)) / (1 + 100 * std::cos(a));
}

std::vector<Segment> segments_of(const std::vector<Stroke>& strokes) {
  std::vector<Segment> segments;
  for (const Stroke& s : strokes) segments.push_back(s.segment);
  return segments;
}

std::vector<Pairing> pairs_at(double threshold) {
  return pairings(tent_map(), straight_scan(), tent_directions(), {.threshold_m = threshold});
}

TEST(Figure6, TheCostsAreThoseOfTheFormula) {
  const auto pairs = pairs_at(0.045);
  ASSERT_EQ(pairs.size(), 6u);
  const double costs[] = {touch_cost(), touch_cost(), flat_cost(), flat_cost(), side_cost(), side_cost()};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(pairs[k].child.cost, costs[k], 1e-12) << k;
}

TEST(Figure6, AtFiveHundredthsEverySegmentIsAParent) {
  const auto a = paired(tent_map(), straight_scan(), pairs_at(0.05), 1);
  for (const Stroke& s : a) EXPECT_EQ(s.created, 1) << "only children are left";
}

TEST(Figure6, AtFourHundredthsTheSidesOfTheTentPairOnce) {
  int left = 0, right = 0;
  for (const Pairing& pair : pairs_at(0.04)) {
    left += pair.map == 1 ? 1 : 0;
    right += pair.map == 2 ? 1 : 0;
  }
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 1);
}

TEST(Figure6, AtThreeHundredthsTheTentStays) {
  ASSERT_LT(flat_cost(), 0.03);
  ASSERT_GT(side_cost(), 0.03);
  const auto a = paired(tent_map(), straight_scan(), pairs_at(0.03), 1);
  // Both sides of the tent, and two children of each flat piece of the map: with the piece of the scan above it,
  // halfway between, and with the next one, at a fifth of the height.
  EXPECT_THAT(segments_of(a), ::testing::UnorderedElementsAre(SegmentNear(tent_map()[1].segment, 0.0),
                                                              SegmentNear(tent_map()[2].segment, 0.0),
                                                              SegmentNear(Segment{{0, 0.1}, {5, 0.1}}, 1e-12),
                                                              SegmentNear(Segment{{5, 0.1}, {10, 0.1}}, 1e-12),
                                                              SegmentNear(Segment{{0, 0.25}, {4, 0.25}}, 1e-12),
                                                              SegmentNear(Segment{{6, 0.25}, {10, 0.25}}, 1e-12)));
}

TEST(Figure6, AtOneHundredthNothingPairs) {
  EXPECT_TRUE(pairs_at(0.01).empty());
  const auto a = paired(tent_map(), straight_scan(), {}, 1);  // the input did not change, its cuts are undone
  ASSERT_EQ(a.size(), 5u);
  EXPECT_TRUE(a[4].segment == (Segment{{0, kHeight}, {10, kHeight}}));
  EXPECT_NEAR(a[4].points, 100.0, 1e-9);
}

TEST(Figure2, ChildrenFollowTheMainDirections) {
  for (const Pairing& pair : pairs_at(0.05)) {
    const Vec2 along = tent_directions()[pair.child.direction];
    EXPECT_NEAR(cross(along, pair.child.segment.direction()), 0.0, 1e-12);
  }
}

TEST(Figure2, ASegmentHasAtMostThreeChildren) {
  const std::vector map{stroke({0, 0}, {5, 0})};
  std::vector<Stroke> scan;
  for (int k = 0; k < 5; ++k) scan.push_back(stroke({k, 0.01 * (5 - k)}, {k + 1.0, 0.01 * (5 - k)}));
  const auto pairs = pairings(map, scan, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0});
  ASSERT_EQ(pairs.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(pairs[k].scan, 4 - k) << "the cheapest, nearest ones";
  EXPECT_EQ(pairings(map, scan, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0, .most_children = 5}).size(), 5u);
}

TEST(Figure2, SegmentsOfOneClassAreNeverPaired) {
  const std::vector map{stroke({0, 0}, {1, 0}), stroke({0, 0}, {1, 0})};
  EXPECT_TRUE(pairings(map, {}, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0}).empty());
  EXPECT_TRUE(pairings({}, map, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0}).empty());
}

TEST(Figure2, FacesOfAThinWallAreNoPairUnlessSidesDoNotCount) {
  const std::vector map{stroke({0, 0}, {1, 0})}, scan{stroke({1, 0.05}, {0, 0.05})};
  EXPECT_TRUE(pairings(map, scan, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0}).empty());
  EXPECT_EQ(pairings(map, scan, std::vector<Vec2>{{1, 0}}, {.threshold_m = 1.0, .same_side = false}).size(), 1u);
}

TEST(Figure2, EvidenceIsSharedAmongChildrenAndNotLost) {
  const auto a = paired(tent_map(), straight_scan(), pairs_at(0.05), 1);
  double points = 0.0, members = 0.0;
  for (const Stroke& s : a) {
    points += s.points;
    members += s.members;
  }
  EXPECT_NEAR(points, 4 * 100 + 100, 1e-9);
  EXPECT_NEAR(members, 4 + 1, 1e-9);
}

TEST(Figure3, SimplificationKeepsBothTheLineAndTheTent) {
  const auto a = paired(tent_map(), straight_scan(), pairs_at(0.03), 1);
  const auto simple = simplified(a, tent_directions(), {.threshold_m = 0.013}, 2);
  // The collinear children at 0.1 go first, at no cost, and make one of length 10. It takes in those at 0.25 one after
  // the other, for 0.0121 and 0.0087: its height becomes (10 * 0.1 + 4 * 0.25) / 14 = 1/7, then (10/7 + 1) / 14.
  ASSERT_EQ(simple.size(), 3u);
  EXPECT_THAT(simple[0].segment, SegmentNear(tent_map()[1].segment, 0.0));
  EXPECT_THAT(simple[1].segment, SegmentNear(tent_map()[2].segment, 0.0));
  EXPECT_THAT(simple[2].segment, SegmentNear(Segment{{0, 17.0 / 98}, {10, 17.0 / 98}}, 1e-9));
}

TEST(Simplification, TheCheapestPairGoesFirst) {
  // Offsets 0, 0.10 and 0.16 of equal segments: the second pairs with the third, whose child (0.13) is too far from the
  // first; merged from the left, 0.05 and 0.16 would have been left.
  const std::vector three{stroke({0, 0}, {1, 0}), stroke({0, 0.10}, {1, 0.10}), stroke({0, 0.16}, {1, 0.16})};
  // Cost of equal parallel segments at distance d: r = 1/2, each D = d, so d / 101.
  const auto simple = simplified(three, std::vector<Vec2>{{1, 0}}, {.threshold_m = 0.11 / 101}, 7);
  ASSERT_EQ(simple.size(), 2u);
  EXPECT_THAT(simple[0].segment, SegmentNear(three[0].segment, 0.0));
  EXPECT_THAT(simple[1].segment, SegmentNear(Segment{{0, 0.13}, {1, 0.13}}, 1e-12));
  EXPECT_EQ(simple[1].created, 7);
  EXPECT_EQ(simple[1].members, 2.0);
}

TEST(Simplification, LeavesNoPairBelowTheThreshold) {
  std::vector<Stroke> bundle;
  for (int k = 0; k < 40; ++k) {
    const double x = 0.37 * k, y = 0.01 * ((k * 7) % 11);
    bundle.push_back(stroke({x, y}, {x + 1, y + 0.02 * ((k * 3) % 5)}));
  }
  const std::vector<Vec2> directions{{1, 0}, {0, 1}};
  const SimplificationRule rule{.threshold_m = 0.002};
  const auto simple = simplified(bundle, directions, rule, 1);
  EXPECT_LT(simple.size(), bundle.size());
  for (std::size_t i = 0; i < simple.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto child = cheapest_child(simple[i].segment, simple[k].segment, directions, rule.merge);
      EXPECT_TRUE(!child || child->cost >= rule.threshold_m);
    }
  double members = 0.0;
  for (const Stroke& s : simple) members += s.members;
  EXPECT_NEAR(members, 40.0, 1e-9);
}

TEST(Simplification, AtThresholdZeroChangesNothing) {
  const auto simple = simplified(tent_map(), tent_directions(), {.threshold_m = 0.0}, 1);
  ASSERT_EQ(simple.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(simple[k].segment == tent_map()[k].segment);
}

TEST(Figure7,
     ASurfaceInANewDirectionIsNotMergedIntoTheOldOnes) {  // children of 45 degrees towards 0 or 90 cost too much
  const std::vector map{stroke({0, 0}, {0.5, 0.5})}, scan{stroke({0.02, 0}, {0.52, 0.5})};
  const PairingRule rule{};
  EXPECT_TRUE(pairings(map, scan, std::vector<Vec2>{{1, 0}, {0, 1}}, rule).empty());
  const auto adopted = pairings(map, scan, std::vector<Vec2>{{1, 0}, {0, 1}, Vec2(1, 1).normalized()}, rule);
  ASSERT_EQ(adopted.size(), 1u);
  EXPECT_EQ(adopted[0].child.direction, 2u);
}

}  // namespace
}  // namespace scanbench::mapping::dse
