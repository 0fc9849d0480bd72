// IEPF against the textbook recursion, and properties that follow from the definition.
#include <algorithm>

#include <gtest/gtest.h>

#include "algorithms/extract/parts/chord.hpp"
#include "tests/support/extraction.hpp"
#include "tests/support/matchers.hpp"

namespace scanbench {
namespace {

using support::beam_runs;
using support::OwnedScan;
using support::random_scan;

const ParamValue kOne = std::int64_t{1};

double distance_to_chord(const Vec2& p, const Vec2& a, const Vec2& b) {
  if ((b - a).norm() < 1e-9) return (p - a).norm();
  const double alpha = std::atan2(b.y() - a.y(), b.x() - a.x()) + kPi / 2;
  return std::fabs((p - a).dot(Vec2(std::cos(alpha), std::sin(alpha))));
}

// The textbook: recursive, on copies.
void split_by_hand(const std::vector<Vec2>& p, int a, int b, double t, std::vector<std::pair<int, int>>& groups) {
  int far = a;
  double best = -1;
  for (int k = a + 1; k < b; ++k) {
    const double d = distance_to_chord(p[static_cast<std::size_t>(k)], p[static_cast<std::size_t>(a)],
                                       p[static_cast<std::size_t>(b)]);
    if (d > best) {
      best = d;
      far = k;
    }
  }
  if (b - a < 2 || best <= t) {
    groups.emplace_back(a, b);
    return;
  }
  split_by_hand(p, a, far, t, groups);
  split_by_hand(p, far, b, t, groups);
}

std::vector<std::pair<int, int>> groups_by_hand(const OwnedScan& scan, double t) {
  std::vector<std::pair<int, int>> groups;
  const ScanPoints points = valid_points(scan.view());
  split_by_hand(points.points, 0, static_cast<int>(points.size()) - 1, t, groups);
  return groups;
}

// Breaks as beams, from the module: every beam has a return in these scans.
std::vector<int> breaks(const OwnedScan& scan, double t) {
  const ScanLines lines =
      support::extract("iepf", scan, {{"threshold_m", t}, {"min_points", kOne}, {"max_gap_m", 0.0}});
  std::vector<int> result;
  for (const auto& line : lines.lines)
    if (line.first_beam > 0) result.push_back(line.first_beam);
  return result;
}

TEST(Iepf, GroupsAreThoseOfTheTextbookRecursion) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const OwnedScan scan = random_scan(seed);
    for (const double t : {0.0, 0.02, 0.1, 0.4}) {
      const auto expected = groups_by_hand(scan, t);
      const ScanLines lines =
          support::extract("iepf", scan, {{"threshold_m", t}, {"min_points", kOne}, {"max_gap_m", 0.0}});
      ASSERT_EQ(lines.lines.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(lines.lines[k].first_beam, expected[k].first);
        // The break point supports the second group.
        EXPECT_EQ(lines.lines[k].last_beam, expected[k].second - (k + 1 < expected.size() ? 1 : 0));
      }
    }
  }
}

TEST(Iepf, EveryPointOfAGroupLiesWithinTheThresholdOfItsChord) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const OwnedScan scan = random_scan(seed);
    std::vector<int> ends = breaks(scan, 0.1);
    ends.insert(ends.begin(), 0);
    ends.push_back(scan.view().beams() - 1);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      for (int i = ends[k]; i <= ends[k + 1]; ++i)
        EXPECT_LE(distance_to_chord(scan.view().point(i), scan.view().point(ends[k]), scan.view().point(ends[k + 1])),
                  0.1 + 1e-9);
  }
}

TEST(Iepf, BreaksForALargerThresholdAreAmongThoseForASmallerOne) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const OwnedScan scan = random_scan(seed);
    std::vector<int> before = breaks(scan, 0.0);
    for (const double t : {0.01, 0.03, 0.1, 0.3, 1.0}) {
      const std::vector<int> now = breaks(scan, t);
      EXPECT_TRUE(std::includes(before.begin(), before.end(), now.begin(), now.end()));
      before = now;
    }
  }
}

TEST(Iepf, BreaksDoNotDependOnTheSenseOfRotation) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const OwnedScan scan = random_scan(seed);
    std::vector<int> back = breaks(support::mirrored(scan), 0.1);
    for (int& b : back) b = scan.view().beams() - 1 - b;
    std::ranges::reverse(back);
    EXPECT_EQ(breaks(scan, 0.1), back);
  }
}

TEST(Iepf, ThresholdZeroGivesAllPairsAndAHugeOneASingleGroup) {
  const OwnedScan scan = random_scan(3);
  EXPECT_EQ(
      support::extract("iepf", scan, {{"threshold_m", 0.0}, {"min_points", kOne}, {"max_gap_m", 0.0}}).lines.size(),
      360u);
  EXPECT_EQ(support::extract("iepf", scan, {{"threshold_m", 1e9}, {"max_gap_m", 0.0}}).lines.size(), 1u);
}

TEST(Iepf, AnIdealPolygonBreaksAtItsVerticesForAnyThresholdBelowTheSmallestDeviation) {
  // Beams exactly at the vertices of a square room seen from its middle: 45, 135, 225, 315 degrees.
  SensorModel sensor;
  sensor.geometry = ScanGeometry(0.0, radians(1), 360);
  OwnedScan scan = support::cast(sensor, support::box(-2, -2, 2, 2));
  for (const int corner : {45, 135, 225, 315}) scan.ranges[static_cast<std::size_t>(corner)] = std::sqrt(8.0);
  for (const double t : {0.001, 0.05, 0.3}) EXPECT_EQ(breaks(scan, t), (std::vector<int>{45, 135, 225, 315})) << t;
}

TEST(Iepf, LinesOfAnIdealRoomAreItsWallsAndReachTheBreakPoints) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(0.5), 541);
  const auto walls = support::box(-2, -2, 2, 2);
  const ScanLines lines = support::extract("iepf", support::cast(sensor, walls));
  ASSERT_EQ(lines.lines.size(), 3u);
  EXPECT_THAT(lines.lines[0].line, support::LineNear(PolarLine{2, -kPi / 2}, 2e-3, 2e-3));
  EXPECT_THAT(lines.lines[1].line, support::LineNear(PolarLine{2, 0}, 2e-3, 2e-3));
  EXPECT_THAT(lines.lines[2].line, support::LineNear(PolarLine{2, kPi / 2}, 2e-3, 2e-3));
  EXPECT_THAT(lines.lines[0].segment.b, support::PointNear(Vec2(2, -2), 0.02));
  EXPECT_THAT(lines.lines[1].segment.a, support::PointNear(Vec2(2, -2), 0.02));
}

// A wall 2 m ahead with 17 beams that return nothing: an opening of 0.6 m.
TEST(Iepf, DoesNotBridgeAnOpeningUnlessRequested) {
  OwnedScan scan = support::cast(support::fan_sensor(41, radians(40)), {{{2, -9}, {2, 9}}});
  for (std::size_t i = 12; i < 29; ++i) scan.ranges[i] = kInf;
  EXPECT_EQ(support::extract("iepf", scan).lines.size(), 2u);
  EXPECT_EQ(support::extract("iepf", scan, {{"max_gap_m", 0.0}}).lines.size(), 1u);
}

TEST(Iepf, ThreeStrayReturnsAreNoLineUnlessRequested) {
  OwnedScan scan = support::cast(support::fan_sensor(41, radians(40)), {{{2, -9}, {2, 9}}});
  for (std::size_t i = 0; i < 41; ++i)
    if (i < 18 || i > 20) scan.ranges[i] = kInf;
  EXPECT_TRUE(support::extract("iepf", scan).lines.empty());
  EXPECT_EQ(support::extract("iepf", scan, {{"min_points", std::int64_t{2}}}).lines.size(), 1u);
}

TEST(Iepf, UnsharedBreaksAreFittedByTheSecondLineOnly) {
  const OwnedScan scan = random_scan(5);
  const ScanLines shared = support::extract("iepf", scan);
  const ScanLines unshared = support::extract("iepf", scan, {{"share_breaks", false}});
  EXPECT_EQ(shared.labels, unshared.labels);
  const Scan view = scan.view();
  for (const LineFeature& f : unshared.lines) {
    std::vector<Vec2> own;
    for (int i = f.first_beam; i <= f.last_beam; ++i) own.push_back(view.point(i));
    EXPECT_THAT(f.line, support::LineNear(fit_line(own).polar(), 1e-9, 1e-9));
  }
}

TEST(Iepf, TheLinearThresholdIsTakenAtTheFarthestPoint) {
  // A tent of height 0.15 at range about 5: T(r) = 0.05 + c r.
  OwnedScan scan = support::cast(support::fan_sensor(41, radians(40)), {{{5, -2}, {5.15, 0}}, {{5.15, 0}, {5, 2}}});
  const auto count = [&](double c) {
    return support::extract("iepf", scan,
                            {{"threshold", std::string("linear")}, {"threshold_m", 0.05}, {"threshold_per_m", c}})
        .lines.size();
  };
  EXPECT_EQ(count(0.0), 2u);
  EXPECT_EQ(count(0.01), 2u);  // 0.1015 < about 0.136 (the chord ends at 20 degrees, not at the ends of the walls)
  EXPECT_EQ(count(0.03), 1u);  // 0.2045
}

// For a straight wall with noise s and T = 2 s: about 16 pieces by IEPF and 6.7 by LT (wall 2 m in front, 101 beams
// over
// +-30 degrees, s = 5 cm), from an independent experiment.
TEST(Iepf, BreaksANoisyWallMoreOftenThanLineTracking) {
  double iepf = 0, lt = 0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    const OwnedScan scan =
        support::with_noise(support::cast(support::fan_sensor(101, radians(60)), {{{2, -9}, {2, 9}}}), 0.05, 11,
                            static_cast<std::uint32_t>(run));
    iepf += static_cast<double>(support::extract("iepf", scan, {{"min_points", kOne}}).lines.size()) / runs;
    lt += static_cast<double>(support::extract("line_tracking", scan, {{"min_points", kOne}}).lines.size()) / runs;
  }
  EXPECT_NEAR(iepf, 16.0, 2.0);
  EXPECT_NEAR(lt, 6.7, 1.0);
}

TEST(Chord, CoincidentEndsMeasureFromTheFirstPointAndTiesGoToTheLowestIndex) {
  const std::vector<Vec2> closed = {{1, 1}, {1, 3}, {3, 1}, {1, 1}};
  const auto far = extract::farthest_from_chord(closed, {0, 3});
  EXPECT_EQ(far.index, 1);
  EXPECT_DOUBLE_EQ(far.distance(), 2.0);
  const std::vector<Vec2> tie = {{0, 0}, {1, 0.5}, {2, 0.5}, {3, 0}};
  EXPECT_EQ(extract::farthest_from_chord(tie, {0, 3}).index, 1);
  EXPECT_DOUBLE_EQ(extract::farthest_from_chord(tie, {0, 3}).distance(), 0.5);
}

}  // namespace
}  // namespace scanbench
