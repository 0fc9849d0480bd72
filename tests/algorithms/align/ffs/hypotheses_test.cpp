// Lines and rectangles of virtual scans, and their prototypes: what a noise-free scene must give.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/align/ffs/hough_lines.hpp"
#include "algorithms/align/ffs/hypotheses.hpp"
#include "algorithms/align/ffs/prototypes.hpp"
#include "algorithms/align/ffs/rectangles.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using namespace align::ffs;

std::vector<Segment> placed(const Pose2& pose, const std::vector<Segment>& segments) {
  std::vector<Segment> result;
  for (const Segment& s : segments) result.push_back(pose * s);
  return result;
}

std::vector<Vec2> points_on(const std::vector<Segment>& segments) {
  std::vector<Vec2> points;
  for (const Segment& s : segments) resample(s, 0.1, points);
  return points;
}

TEST(HoughLines, FindTheLineOfCollinearPiecesAtAnyAngle) {
  for (int deg = 0; deg < 180; deg += 7) {
    const Pose2 pose(3, -2, radians(deg + 0.4));
    const auto pieces = placed(pose, {{{0, 1}, {2, 1}}, {{3, 1}, {6, 1}}});
    const auto lines = hough_lines(points_on(pieces), {});
    ASSERT_EQ(lines.size(), 1u) << deg;
    EXPECT_EQ(lines[0].certainty, 1.0);
    for (const Segment& s : pieces)
      for (const Vec2& p : {s.a, s.b}) EXPECT_NEAR(lines[0].normal.dot(p), lines[0].offset, 1e-3) << deg;
  }
}

TEST(HoughLines, OfEqualStrengthHaveEqualCertaintyAndWeakOnesAreLeftOut) {
  const auto lines = hough_lines(points_on({{{0, 0}, {8, 0}}, {{0, 5}, {8, 5}}, {{1, 1}, {1, 2}}}), {});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[1].certainty, 1.0, 0.05);
  EXPECT_TRUE(hough_lines({}, {}).empty());
}

TEST(HoughLines, AreClippedToTheMap) {
  const std::vector<Vec2> corners{{0, 0}, {4, 2}};
  const Segment part = clipped({{0, 1}, 0.5, 1, 1}, corners);
  EXPECT_NEAR(part.length(), 4.0, 1e-12);
  EXPECT_EQ(clipped({{0, 1}, 3.0, 1, 1}, corners).length(), 0.0);
}

TEST(Rectangles, AnExactOneIsFoundWithCertaintyOneAndExactCorners) {
  const Pose2 pose(2, 5, 0.7);
  const auto found = rectangles_of(placed(pose, support::box(0, 0, 4, 2.5)), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].certainty, 1.0, 1e-9);
  for (const Vec2& corner : {Vec2(0, 0), Vec2(4, 0), Vec2(4, 2.5), Vec2(0, 2.5)}) {
    double nearest = 1e9;
    for (const Vec2& c : found[0].corners) nearest = std::min(nearest, (c - pose * corner).norm());
    EXPECT_LT(nearest, 1e-9);
  }
}

TEST(Rectangles, CertaintyFallsWithWhatIsMissingOfTheSides) {
  double last = 1.1;
  for (const double missing : {0.0, 0.3, 0.6, 0.9}) {
    auto sides = support::box(0, 0, 4, 2.5);
    sides[0] = {{missing / 2, 0}, {4 - missing / 2, 0}};
    const auto found = rectangles_of(sides, {});
    ASSERT_EQ(found.size(), 1u) << missing;
    EXPECT_NEAR(found[0].certainty, (13.0 - missing) / 13.0, 1e-9);
    EXPECT_LT(found[0].certainty, last);
    last = found[0].certainty;
  }
}

TEST(Rectangles, ThreeSidesAndSkewedOnesAreNone) {
  auto sides = support::box(0, 0, 4, 2.5);
  sides.pop_back();
  EXPECT_TRUE(rectangles_of(sides, {}).empty());
  EXPECT_TRUE(rectangles_of(support::polygon({{0, 0}, {4, 0}, {5.5, 2.5}, {1.5, 2.5}}), {}).empty());
  EXPECT_TRUE(rectangles_of({}, {}).empty());
}

TEST(Rectangles, DoNotDependOnTheOrderOrTheDirectionOfSegments) {
  auto sides = support::box(0, 0, 4, 2.5);
  const auto found = rectangles_of(sides, {});
  std::swap(sides[0], sides[3]);
  sides[1] = {sides[1].b, sides[1].a};
  const auto again = rectangles_of(sides, {});
  ASSERT_EQ(again.size(), found.size());
  EXPECT_THAT(again[0].centre(), support::PointNear(found[0].centre(), 1e-12));
  EXPECT_NEAR(again[0].certainty, found[0].certainty, 1e-12);
}

TEST(Prototypes, OneStandsForTheSegmentsOfAWallAcrossADoor) {
  const auto found = prototypes_of(
      std::vector<Segment>{{{0, 0}, {2, 0.02}}, {{1.5, 0.1}, {3, 0.1}}, {{4, 0.05}, {6, 0.05}}, {{0, 1}, {3, 1}}}, {});
  ASSERT_EQ(found.size(), 2u);
  const Segment& wall = found[0].length() > found[1].length() ? found[0] : found[1];
  EXPECT_NEAR(wall.length(), 6.0, 0.01);
  EXPECT_NEAR(wall.midpoint().y(), 0.05, 0.03);
}

TEST(Prototypes, ParallelWallsAndCornersStayApart) {
  EXPECT_EQ(prototypes_of(support::box(0, 0, 4, 2.5), {}).size(), 4u);
  EXPECT_EQ(prototypes_of(std::vector<Segment>{{{0, 0}, {3, 0}}, {{0, 0.3}, {3, 0.3}}}, {}).size(), 2u);
}

TEST(VirtualScan, PointsLieOnTheirHypothesesWithWeightsByCertainty) {
  HypothesisRules rules;
  rules.line_weight = 0.5;
  rules.rectangle_weight = 2.0;
  const std::vector<Hypothesis> hypotheses{{Shape::line, {{0, 0}, {4, 0}}, 0.8, -1},
                                           {Shape::rectangle, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0.6, -1}};
  const VirtualScan scan = plotted(hypotheses, rules);
  ASSERT_EQ(scan.points.size(), scan.weights.size());
  ASSERT_EQ(scan.points.size(), scan.directions.size());
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const bool on_line = scan.side[k] < 0;
    EXPECT_NEAR(scan.weights[k], on_line ? 0.4 : 1.2, 1e-12);
    double nearest = 1e9;
    if (on_line) nearest = distance(scan.points[k], Segment{{0, 0}, {4, 0}});
    if (!on_line) {
      const std::vector<Segment> sides = support::box(0, 0, 2, 1);
      for (const Segment& side : sides) nearest = std::min(nearest, distance(scan.points[k], side));
      EXPECT_EQ(scan.side[k] / 4, 1) << "the second hypothesis";
      const Vec2 from = hypotheses[1].corners[static_cast<std::size_t>(scan.side[k] % 4)];
      EXPECT_NEAR(cross(scan.directions[k], scan.points[k] - from), 0.0, 1e-12) << "on the side that begins there";
    }
    EXPECT_LT(nearest, 1e-12);
  }
}

}  // namespace
}  // namespace scanbench
