// Split-and-merge fuzzy line extraction, Borges & Aldon 2000, section 3: the properties that the two phases promise.
#include "algorithms/extract/smf/phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "core/geometry/pose2.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

using SmfPoints = std::vector<Vec2>;

Trace smf_silent;

std::vector<SmfLine> smf(const SmfPoints& points, const SmfOptions& options = {}) {
  return smf_merge(points, smf_split(points, options, smf_silent), options, smf_silent);
}

SmfPoints clutter(std::uint32_t seed, int n) {
  CounterRng rng(seed, RngStream::pose);
  SmfPoints points;
  Vec2 p(3, 0);
  double heading = 1.5;
  for (int i = 0; i < n; ++i) {
    if (rng.uniform() < 0.08) heading += 3 * (rng.uniform() - 0.5);
    if (rng.uniform() < 0.03) p += Vec2(rng.normal(), rng.normal());
    p += 0.08 * Vec2(std::cos(heading), std::sin(heading));
    points.push_back(p + 0.03 * Vec2(rng.normal(), rng.normal()));
  }
  return points;
}

std::vector<int> every_index(const SmfPoints& points) {
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void expect_partition(const std::vector<SmfLine>& lines, std::size_t n) {
  std::vector<int> all;
  for (const SmfLine& line : lines) {
    EXPECT_TRUE(std::is_sorted(line.support.begin(), line.support.end()));
    EXPECT_FALSE(line.support.empty());
    all.insert(all.end(), line.support.begin(), line.support.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, every_index(SmfPoints(n)));
}

// Root mean square distance of the support to its least-squares line, from the points and by eigenvalues of the
// scatter matrix.
double dispersion(const SmfPoints& points, const std::vector<int>& support) {
  Vec2 centre = Vec2::Zero();
  for (const int j : support) centre += points[static_cast<std::size_t>(j)];
  centre /= static_cast<double>(support.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const int j : support) {
    const Vec2 d = points[static_cast<std::size_t>(j)] - centre;
    scatter += d * d.transpose();
  }
  const double half_trace = 0.5 * scatter.trace();
  const double root = std::sqrt(std::max(0.0, half_trace * half_trace - scatter.determinant()));
  return std::sqrt(std::max(0.0, half_trace - root) / static_cast<double>(support.size()));
}

std::set<std::vector<int>> supports(const std::vector<SmfLine>& lines) {
  std::set<std::vector<int>> result;
  for (const SmfLine& line : lines) result.insert(line.support);
  return result;
}

class EveryInitialisation : public testing::TestWithParam<SmfInitialisation> {};
INSTANTIATE_TEST_SUITE_P(Smf, EveryInitialisation,
                         testing::Values(SmfInitialisation::scan_order, SmfInitialisation::principal_axis,
                                         SmfInitialisation::farthest));

TEST_P(EveryInitialisation, KeepsAPartitionWithinTheThresholdInBothPhases) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const SmfPoints points = clutter(seed, 150);
    for (const double sigma_max : {0.02, 0.05, 0.2}) {
      const SmfOptions options{.sigma_max_m = sigma_max, .initialisation = GetParam()};
      const auto after_split = smf_split(points, options, smf_silent);
      expect_partition(after_split, points.size());
      for (const SmfLine& line : after_split)
        EXPECT_TRUE(line.support.size() <= 2 || dispersion(points, line.support) <= sigma_max * (1 + 1e-9));
      const auto after_merge = smf_merge(points, after_split, options, smf_silent);
      expect_partition(after_merge, points.size());
      EXPECT_LE(after_merge.size(), after_split.size());
      for (const SmfLine& line : after_merge)
        EXPECT_TRUE(line.support.size() <= 2 || dispersion(points, line.support) <= sigma_max * (1 + 1e-9));
    }
  }
}

TEST_P(EveryInitialisation, LeavesNoLineThatCouldBeFusedWithOneOfItsTwoNearest) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const SmfPoints points = clutter(seed, 150);
    const SmfOptions options{.initialisation = GetParam()};
    const auto lines = smf(points, options);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      std::vector<std::size_t> others;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (i != k) others.push_back(i);
      const auto distance = [&](std::size_t i) {
        return (lines[i].moments.centroid() - lines[k].moments.centroid()).norm();
      };
      std::stable_sort(others.begin(), others.end(),
                       [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
      for (std::size_t c = 0; c < std::min<std::size_t>(2, others.size()); ++c) {
        std::vector<int> united = lines[k].support;
        united.insert(united.end(), lines[others[c]].support.begin(), lines[others[c]].support.end());
        EXPECT_GT(dispersion(points, united), 0.05 * (1 - 1e-9));
      }
    }
  }
}

TEST_P(EveryInitialisation, CutsANoiseFreeCornerIntoItsTwoLegs) {
  CounterRng rng(1, RngStream::pose);
  int wrong = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const double first = 0.4 + 3.6 * rng.uniform();
    const double second = 0.4 + 3.6 * rng.uniform();
    const double turn = radians(45 + 90 * rng.uniform());  // inner angle between the legs
    const double heading = kTwoPi * rng.uniform();
    const Vec2 corner(2 * rng.normal(), 2 * rng.normal());
    SmfPoints points;
    const Vec2 u(std::cos(heading), std::sin(heading));
    const Vec2 v(std::cos(heading + turn), std::sin(heading + turn));
    for (double t = first; t > 0; t -= 0.05) points.push_back(corner + t * u);
    for (double t = 0.05; t <= second; t += 0.05) points.push_back(corner + t * v);
    for (const double sigma_max : {0.02, 0.05})
      wrong += smf(points, {.sigma_max_m = sigma_max, .initialisation = GetParam()}).size() != 2;
  }
  EXPECT_LE(
      wrong,
      2);  // of 200: the clusters are compact, and the few points that they leave at a corner may remain a cluster
}

TEST(Smf, SeesARectangularRoomAsAboutOneLinePerWall) {
  int exact = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    CounterRng rng(seed, RngStream::pose);
    const double w = 3 + 7 * rng.uniform(), h = 3 + 7 * rng.uniform();
    const Vec2 sensor((0.2 + 0.6 * rng.uniform()) * w, (0.2 + 0.6 * rng.uniform()) * h);
    SmfPoints points;
    for (int i = 0; i < 360; ++i) {
      const Vec2 d(std::cos(radians(i)), std::sin(radians(i)));
      double r = std::numeric_limits<double>::infinity();
      if (d.x() > 0) r = std::min(r, (w - sensor.x()) / d.x());
      if (d.x() < 0) r = std::min(r, -sensor.x() / d.x());
      if (d.y() > 0) r = std::min(r, (h - sensor.y()) / d.y());
      if (d.y() < 0) r = std::min(r, -sensor.y() / d.y());
      points.push_back((r + 0.02 * rng.normal()) * d);
    }
    const auto lines = smf(points);
    EXPECT_GE(lines.size(), 3u);
    EXPECT_LE(lines.size(), 6u);
    exact += lines.size() == 4;
  }
  EXPECT_GE(exact, 75);  // about 87 of 100
}

TEST(Smf, SeesOneWallAsOneLine) {
  CounterRng rng(4, RngStream::range);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 10 + static_cast<int>(rng.bits() % 190);
    SmfPoints points;
    for (int i = 0; i < n; ++i) points.emplace_back(2.0 + 0.05 / 1.5 * rng.normal(), -1.0 + 0.02 * i);
    EXPECT_TRUE(dispersion(points, every_index(points)) > 0.05 || smf(points).size() == 1);
  }
}

TEST(Smf, PartitionDoesNotDependOnTheFrameOrTheUnit) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const SmfPoints points = clutter(seed, 120);
    const Pose2 motion(-4.0, 2.5, 0.7 + seed);
    SmfPoints moved, scaled;
    for (const Vec2& p : points) {
      moved.push_back(motion * p);
      scaled.push_back(4.0 * p);
    }
    const auto expected = supports(smf(points));
    EXPECT_EQ(supports(smf(moved)), expected);
    SmfOptions larger{.sigma_max_m = 0.2};
    larger.fuzzy.rho_tolerance_m *= 4;
    EXPECT_EQ(supports(smf(scaled, larger)), expected);
  }
}

TEST(Smf, PenaltyInTheDispersionShattersAWall) {
  SmfPoints points;
  for (int i = 0; i < 40; ++i) points.emplace_back(2.0, -1.0 + 0.05 * i);
  EXPECT_EQ(smf(points).size(), 1u);
  EXPECT_GT(smf(points, {.penalty_in_dispersion = true}).size(), 5u);
}

TEST(Smf, FusesAcrossAnOpeningUnlessMaxGapForbidsIt) {
  // Two coplanar walls and a deep box between them, which forces the split.
  SmfPoints points;
  for (int i = 0; i < 20; ++i) points.emplace_back(2.0, 0.05 * i);
  for (int i = 0; i < 20; ++i) points.emplace_back(3.0, 1.0 + 0.05 * i);
  for (int i = 0; i < 20; ++i) points.emplace_back(2.0, 2.0 + 0.05 * i);
  EXPECT_EQ(smf(points).size(), 2u);
  EXPECT_EQ(smf(points, {.max_gap_m = 0.5}).size(), 3u);
  EXPECT_EQ(smf(points, {.max_gap_m = 1.2}).size(), 2u);
}

TEST(Smf, LinesOfOneOrTwoPointsAreNeverSplit) {
  const SmfPoints far_apart = {{0, 0}, {10, 3}};
  EXPECT_EQ(smf_split(far_apart, {}, smf_silent).size(), 1u);
  EXPECT_EQ(smf_split(SmfPoints{{1, 1}}, {}, smf_silent).size(), 1u);
  EXPECT_TRUE(smf_split(SmfPoints{}, {}, smf_silent).empty());
}

TEST(Smf, EndsOnPointsInOnePlaceAndOnAnIsotropicCloud) {
  EXPECT_EQ(smf(SmfPoints(50, Vec2(1, 1))).size(), 1u);
  const SmfPoints square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  expect_partition(smf(square), 4);
}

// ---- the module

SensorModel sensor(int beams) {
  SensorModel s;
  s.geometry = ScanGeometry(radians(-90), radians(0.5), beams);
  return s;
}

TEST(SmfModule, GivesLinesInScanOrderWithLabelsAndEndPointsOfTheirSupport) {
  const SensorModel s = sensor(361);
  std::vector<double> ranges(361, std::numeric_limits<double>::infinity());
  for (int i = 0; i < 361;
       ++i) {  // a corner at (2, 1) seen from the origin, walls x = 2 and y = 1, a hole in the first
    const Vec2 d = s.geometry.direction(i);
    if (i >= 100 && i < 110) continue;
    double r = std::numeric_limits<double>::infinity();
    if (d.x() > 1e-9) r = 2.0 / d.x();
    if (d.y() > 1e-9) r = std::min(r, 1.0 / d.y());
    if (r < 6) ranges[static_cast<std::size_t>(i)] = r;
  }
  const auto module = Registry<LineExtractor>::make("smf");
  const ScanLines out = module->extract({s, ranges}, smf_silent);
  ASSERT_EQ(out.labels.size(), ranges.size());
  ASSERT_EQ(out.lines.size(), 2u);
  EXPECT_LT(out.lines[0].first_beam, out.lines[1].first_beam);
  const auto wall_x = line_difference(out.lines[0].line, {2.0, 0.0});
  const auto wall_y = line_difference(out.lines[1].line, {1.0, kPi / 2});
  EXPECT_LT(wall_x.rho + wall_x.alpha, 0.02);
  EXPECT_LT(wall_y.rho + wall_y.alpha, 0.02);
  for (std::size_t k = 0; k < 2; ++k) {
    const LineFeature& line = out.lines[k];
    EXPECT_EQ(std::count(out.labels.begin(), out.labels.end(), static_cast<int>(k)), line.points);
    EXPECT_EQ(out.labels[static_cast<std::size_t>(line.first_beam)], static_cast<int>(k));
    EXPECT_EQ(out.labels[static_cast<std::size_t>(line.last_beam)], static_cast<int>(k));
    EXPECT_LT((line.segment.a - Scan{s, ranges}.point(line.first_beam)).norm(), 0.15);
    EXPECT_LT((line.segment.b - Scan{s, ranges}.point(line.last_beam)).norm(), 0.15);
  }
  for (int i = 100; i < 110; ++i) EXPECT_EQ(out.labels[static_cast<std::size_t>(i)], -1);
}

TEST(SmfModule, FindsNothingWhereNothingReturned) {
  const auto module = Registry<LineExtractor>::make("smf");
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {inf, -inf, std::nan(""), 0.0, -1.0}) {
    const SensorModel s = sensor(20);
    const std::vector<double> ranges(20, value);
    const ScanLines out = module->extract({s, ranges}, smf_silent);
    EXPECT_TRUE(out.lines.empty());
    EXPECT_EQ(out.labels, std::vector<int>(20, -1));
  }
  const SensorModel none = sensor(0);
  EXPECT_TRUE(module->extract({none, {}}, smf_silent).labels.empty());
}

TEST(SmfModule, DropsLinesWithFewerPointsThanRequested) {
  const SensorModel s = sensor(30);
  std::vector<double> ranges(30, 2.0);
  for (std::size_t i = 12; i < 15; ++i) ranges[i] = 9.0;
  const auto out =
      Registry<LineExtractor>::make("smf", {{"min_points", std::int64_t{5}}})->extract({s, ranges}, smf_silent);
  for (const LineFeature& line : out.lines) EXPECT_GE(line.points, 5);
  EXPECT_EQ(out.labels[13], -1);
  EXPECT_FALSE(out.lines.empty());
}

TEST(SmfModule, RefusesParametersOutOfBounds) {
  EXPECT_THROW(Registry<LineExtractor>::make("smf", {{"sigma_max_m", 0.0}}), ParamError);
  EXPECT_THROW(Registry<LineExtractor>::make("smf", {{"fuzzifier", 1.0}}), ParamError);
}

}  // namespace
}  // namespace scanbench::extract
