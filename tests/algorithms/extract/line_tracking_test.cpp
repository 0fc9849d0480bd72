// Line tracking against a refit at every step, and properties that follow from the definition.
#include <gtest/gtest.h>

#include "tests/support/extraction.hpp"
#include "tests/support/matchers.hpp"

namespace scanbench {
namespace {

using support::beam_runs;
using support::OwnedScan;
using support::random_scan;

const ParamValue kWeightOne = std::int64_t{1};

// Total least squares as printed in textbooks, with the angle.
double distance_to_fit(const std::vector<Vec2>& p, int first, int last, const Vec2& q) {
  Vec2 c = Vec2::Zero();
  for (int i = first; i <= last; ++i) c += p[static_cast<std::size_t>(i)] / (last - first + 1);
  double sxx = 0, sxy = 0, syy = 0;
  for (int i = first; i <= last; ++i) {
    const Vec2 d = p[static_cast<std::size_t>(i)] - c;
    sxx += d.x() * d.x();
    sxy += d.x() * d.y();
    syy += d.y() * d.y();
  }
  const double alpha = 0.5 * std::atan2(-2 * sxy, syy - sxx);
  return std::fabs((q - c).dot(Vec2(std::cos(alpha), std::sin(alpha))));
}

template <class ThresholdOfPoint>
std::vector<std::pair<int, int>> groups_by_hand(const std::vector<Vec2>& p, ThresholdOfPoint&& threshold) {
  std::vector<std::pair<int, int>> groups;
  const int n = static_cast<int>(p.size());
  int i = 0;
  while (i < n) {
    int last = std::min(i + 1, n - 1);
    while (last + 1 < n) {
      const Vec2& next = p[static_cast<std::size_t>(last + 1)];
      if (distance_to_fit(p, i, last, next) > threshold(next)) break;
      ++last;
    }
    groups.emplace_back(i, last);
    i = last + 1;
  }
  return groups;
}

TEST(LineTracking, GroupsAreThoseOfARefitAtEveryStep) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const OwnedScan scan = random_scan(seed);
    const auto points = valid_points(scan.view()).points;
    for (const double t : {0.02, 0.1, 0.4}) {
      EXPECT_EQ(beam_runs(support::extract("line_tracking", scan, {{"threshold_m", t}, {"min_points", kWeightOne}})),
                groups_by_hand(points, [t](const Vec2&) { return t; }));
      const ParamSet linear = {{"threshold", std::string("linear")},
                               {"threshold_m", t},
                               {"threshold_per_m", 0.02},
                               {"min_points", kWeightOne}};
      EXPECT_EQ(beam_runs(support::extract("line_tracking", scan, linear)),
                groups_by_hand(points, [t](const Vec2& p) { return t + 0.02 * p.norm(); }));
    }
  }
}

TEST(LineTracking, EveryGroupButTheLastHasTwoPointsOrMore) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ScanLines lines =
        support::extract("line_tracking", random_scan(seed), {{"threshold_m", 0.001}, {"min_points", kWeightOne}});
    for (std::size_t k = 0; k + 1 < lines.lines.size(); ++k) EXPECT_GE(lines.lines[k].points, 2);
  }
}

TEST(LineTracking, EveryRejectedPointIsFartherThanTheThresholdFromTheLineBeforeIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const OwnedScan scan = random_scan(seed);
    const ScanLines lines = support::extract("line_tracking", scan, {{"min_points", kWeightOne}});
    for (std::size_t k = 0; k + 1 < lines.lines.size(); ++k) {
      const Vec2 rejected = scan.view().point(lines.lines[k + 1].first_beam);
      if (lines.lines[k].points > 2 || lines.lines[k].rms_m < 1e-12) {
        EXPECT_GT(std::fabs(lines.lines[k].line.signed_distance(rejected)), 0.1 - 1e-9);
      }
    }
  }
}

TEST(LineTracking, ResidualsInsideALineMayExceedTheThresholdBecauseTheLineTurnsAsItGrows) {
  bool exceeded = false;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const OwnedScan scan = random_scan(seed);
    for (const LineFeature& f : support::extract("line_tracking", scan).lines)
      for (int i = f.first_beam; i <= f.last_beam; ++i)
        exceeded = exceeded || std::fabs(f.line.signed_distance(scan.view().point(i))) > 0.1 + 1e-9;
  }
  EXPECT_TRUE(exceeded);
}

TEST(LineTracking, AnIdealRoomHasOneLinePerWallWithBreaksWithinAPointOfTheCorners) {
  const OwnedScan scan = support::cast(support::fan_sensor(541, radians(270)), support::box(-2.5, -2, 3, 1.7));
  const ScanLines lines =
      support::extract("line_tracking", scan, {{"threshold_m", 0.005}, {"min_points", std::int64_t{3}}});
  std::vector<int> corners;
  for (int i = 1; i < scan.view().beams(); ++i)
    if (scan.ids[static_cast<std::size_t>(i)] != scan.ids[static_cast<std::size_t>(i - 1)]) corners.push_back(i);
  ASSERT_EQ(lines.lines.size(), corners.size() + 1);
  for (std::size_t k = 0; k < corners.size(); ++k) EXPECT_NEAR(lines.lines[k + 1].first_beam, corners[k], 1);
}

TEST(LineTracking, PointsAndThresholdScaleTogether) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    OwnedScan scan = random_scan(seed);
    const auto before = beam_runs(support::extract("line_tracking", scan, {{"threshold_m", 0.1}}));
    for (double& r : scan.ranges) r *= 4.0;  // a power of two: exact
    EXPECT_EQ(before, beam_runs(support::extract("line_tracking", scan, {{"threshold_m", 0.4}})));
  }
}

}  // namespace
}  // namespace scanbench
