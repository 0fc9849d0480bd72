// From groups to lines: supports, end points, fits. Expected values from geometry.
#include "algorithms/extract/parts/groups.hpp"

#include <gtest/gtest.h>

#include "core/geometry/portable_math.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using namespace extract;
using support::LineNear;
using support::PointNear;

const std::vector<Vec2> kLine = {{1, 2}, {2, 2.5}, {4, 3.5}, {5, 4}};  // y = 1.5 + x/2

TEST(FitGroup, AllThreeFitsAreExactForCollinearPoints) {
  const PolarLine truth = line_through(kLine.front(), kLine.back());
  for (const Fit fit : {Fit::end_points, Fit::tls, Fit::siadat}) {
    const LineFit line = fit_group(kLine, fit);
    EXPECT_FALSE(line.degenerate);
    EXPECT_THAT(line.polar(), LineNear(truth, 1e-12, 1e-12));
    EXPECT_NEAR(line.rms(), 0.0, 1e-7);
  }
}

TEST(FitGroup, EndPointsIgnoreThePointsBetweenAndCountTheirResiduals) {
  const std::vector<Vec2> points = {{1, 0}, {2, 0.3}, {3, 0}};
  const LineFit line = fit_group(points, Fit::end_points);
  EXPECT_THAT(line.polar(), LineNear(PolarLine{0, kPi / 2}, 1e-12, 1e-12));
  EXPECT_NEAR(line.rms(), std::sqrt(0.09 / 3), 1e-12);
}

TEST(FitGroup, SiadatMinimisesSquaredDistancesOverRhoSquared) {
  // Brute force over (alpha, rho) of sum d_i^2 / rho^2, the functional that eqs 4-6 minimise.
  const std::vector<Vec2> points = {{2.0, -1.0}, {2.1, -0.4}, {1.9, 0.1}, {2.15, 0.6}, {1.95, 1.2}};
  const auto cost = [&](double alpha, double rho) {
    double sum = 0;
    for (const Vec2& p : points) {
      const double d = rho - p.x() * std::cos(alpha) - p.y() * std::sin(alpha);
      sum += d * d;
    }
    return sum / (rho * rho);
  };
  double best = 1e9, best_alpha = 0, best_rho = 0;
  for (int i = -400; i <= 400; ++i)
    for (int j = 0; j <= 400; ++j) {
      const double alpha = i * 5e-4, rho = 1.9 + j * 5e-4;
      if (cost(alpha, rho) < best) best = cost(alpha, rho), best_alpha = alpha, best_rho = rho;
    }
  EXPECT_THAT(fit_group(points, Fit::siadat).polar(), LineNear(PolarLine{best_rho, best_alpha}, 4e-4, 4e-4));
}

TEST(FitGroup, SiadatIsBiasedOutwardsBySigmaSquaredOverRho) {
  // E[rho] - rho = sigma^2 / rho to leading order for points symmetric about the foot of the perpendicular.
  const double rho = 0.5, sigma = 0.02;
  double sum = 0;
  const int runs = 4000, n = 41;
  for (int run = 0; run < runs; ++run) {
    CounterRng rng(7, RngStream::range, static_cast<std::uint32_t>(run));
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) points.emplace_back(rho + sigma * rng.normal(), -1.0 + 2.0 * i / (n - 1));
    sum += fit_group(points, Fit::siadat).polar().rho - rho;
  }
  const double expected = sigma * sigma / rho;
  const double standard_error = sigma / std::sqrt(double{n} * runs);
  EXPECT_NEAR(sum / runs, expected, 4 * standard_error + 0.1 * expected);
}

TEST(FitGroup, SiadatFallsBackToTotalLeastSquaresForPointsOnOneRay) {
  const std::vector<Vec2> points = {{1, 1}, {2, 2}, {3, 3}};
  EXPECT_THAT(fit_group(points, Fit::siadat).polar(), LineNear(PolarLine{0, 3 * kPi / 4}, 1e-12, 1e-12));
}

TEST(FitGroup, AGroupWithoutADirectionLiesAcrossTheRay) {
  for (const Fit fit : {Fit::end_points, Fit::tls, Fit::siadat}) {
    for (const std::vector<Vec2>& points : {std::vector<Vec2>{{3, 4}}, std::vector<Vec2>(3, Vec2(3, 4))}) {
      const LineFit line = fit_group(points, fit);
      EXPECT_TRUE(line.degenerate);
      EXPECT_THAT(line.polar(), LineNear(PolarLine{5, portable::atan2(4, 3)}, 1e-12, 1e-12));
    }
    EXPECT_EQ(fit_group({}, fit).weight, 0.0);
  }
}

// A wall x = 2 seen by five beams.
support::OwnedScan wall_scan() {
  return support::cast(support::fan_sensor(5, radians(60)), {{{2, -9}, {2, 9}}});
}

TEST(LinesOfRuns, ASharedBreakPointSupportsTheSecondRunButEndsBothSegments) {
  const auto scan = wall_scan();
  const ScanPoints points = valid_points(scan.view());
  const std::vector<PointRun> runs = {{0, 2}, {2, 4}};
  const ScanLines lines = lines_of_runs(scan.view(), points, runs, Fit::tls);
  ASSERT_EQ(lines.lines.size(), 2u);
  EXPECT_EQ(lines.labels, (std::vector<int>{0, 0, 1, 1, 1}));
  EXPECT_EQ(lines.lines[0].points, 2);
  EXPECT_EQ(lines.lines[0].last_beam, 1);
  EXPECT_EQ(lines.lines[1].points, 3);
  EXPECT_EQ(lines.lines[1].first_beam, 2);
  EXPECT_THAT(lines.lines[0].segment.b, PointNear(Vec2(2, 0), 1e-12));
  EXPECT_THAT(lines.lines[1].segment.a, PointNear(Vec2(2, 0), 1e-12));
  for (const auto& line : lines.lines) EXPECT_THAT(line.line, LineNear(PolarLine{2, 0}, 1e-12, 1e-12));
}

TEST(LinesOfRuns, RunsBelowTheRulesLeaveTheirBeamsUnlabelled) {
  const auto scan = wall_scan();
  const ScanPoints points = valid_points(scan.view());
  const std::vector<PointRun> runs = {{0, 0}, {1, 2}, {3, 4}};
  EXPECT_EQ(lines_of_runs(scan.view(), points, runs, Fit::tls).labels, (std::vector<int>{-1, 0, 0, 1, 1}));
  // Neighbouring points are 2 (tan 30 - tan 15) = 0.619 m and 2 tan 15 = 0.536 m apart.
  EXPECT_EQ(lines_of_runs(scan.view(), points, runs, Fit::tls, {2, 0.6}).labels, (std::vector<int>{-1, -1, -1, 0, 0}));
  const ScanLines all = lines_of_runs(scan.view(), points, runs, Fit::tls, {1, 0.0});
  EXPECT_EQ(all.labels, (std::vector<int>{0, 1, 1, 2, 2}));
  EXPECT_EQ(all.lines[0].segment.length(), 0.0);
  EXPECT_EQ(all.lines[0].points, 1);
}

TEST(LinesOfRuns, TheSensorIsOnTheLeftForEitherSenseOfRotation) {
  for (const double step : {radians(15), -radians(15)}) {
    SensorModel sensor;
    sensor.geometry = ScanGeometry(-2 * step, step, 5);
    const auto scan = support::cast(sensor, {{{2, -9}, {2, 9}}});
    const std::vector<PointRun> runs = {{0, 4}};
    const ScanLines lines = lines_of_runs(scan.view(), valid_points(scan.view()), runs, Fit::tls);
    ASSERT_EQ(lines.lines.size(), 1u);
    EXPECT_LT(lines.lines[0].segment.a.y(), lines.lines[0].segment.b.y());
  }
}

TEST(LinesOfGroups, LinesComeInTheOrderOfTheirFirstBeamWithExtremeProjectionsAsEnds) {
  const auto scan = wall_scan();
  const ScanPoints points = valid_points(scan.view());
  const std::vector<int> group = {2, 0, -1, 0, 2};
  const ScanLines lines = lines_of_groups(scan.view(), points, group, 3, Fit::tls);
  ASSERT_EQ(lines.lines.size(), 2u);
  EXPECT_EQ(lines.labels, (std::vector<int>{0, 1, -1, 1, 0}));
  EXPECT_EQ(lines.lines[0].first_beam, 0);
  EXPECT_EQ(lines.lines[0].last_beam, 4);
  EXPECT_EQ(lines.lines[0].points, 2);
  EXPECT_THAT(lines.lines[0].segment.a, PointNear(points.points[0], 1e-12));
  EXPECT_THAT(lines.lines[0].segment.b, PointNear(points.points[4], 1e-12));
}

}  // namespace
}  // namespace scanbench
