// efficiency: the bound compared with numerical derivatives and with a Monte-Carlo maximum-likelihood estimate; errors
// computed by hand.
#include <algorithm>

#include <Eigen/LU>

#include "core/index.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "made_up.hpp"
#include "metrics/line_bound.hpp"
#include "metrics/rows.hpp"

namespace scanbench::test {
namespace {

using metrics::join_walls;
using metrics::line_bound;

/// 41 beams over 40 deg on the wall (2 m, 30 deg), beside its foot, so that offset and angle are correlated everywhere
/// except in the middle.
const PolarLine kWall{2.0, radians(30)};
const ScanGeometry kFan(radians(40), radians(1), 41);

MadeUpRun fan(const SensorNoise& noise, int frames = 1) {
  const Vec2 foot = kWall.rho * kWall.normal();
  const Vec2 along = perpendicular(kWall.normal());
  MadeUpRun run = make_run(kFan, {{"wall", {foot - 20 * along, foot + 20 * along}}});
  run.observed.sensor.noise = noise;
  for (int f = 0; f < frames; ++f) cast_frame(run, {});
  return run;
}

metrics::TrueLine only_true_line(const MadeUpRun& run) {
  const auto lines = metrics::true_lines(run.input(), 0, join_walls(run.truth.walls), {});
  EXPECT_EQ(lines.size(), 1u);
  return lines.at(0);
}

double range_to(double rho, double alpha, double phi) {
  return rho / std::cos(phi - alpha);
}

/// (offset at the point, angle) of the line (rho, alpha) against kWall.
Eigen::Vector2d displacement(double rho, double alpha, const Vec2& point) {
  return {rho - point.x() * std::cos(alpha) - point.y() * std::sin(alpha), alpha - kWall.alpha};
}

TEST(LineBound, IsTheInverseInformationFromNumericalDerivatives) {
  SensorNoise noise;
  noise.sigma_m = 0.02;
  noise.sigma_relative = 0.01;
  noise.quantum_m = 0.01;
  noise.bearing_sigma_rad = radians(0.1);
  MadeUpRun run = fan(noise);
  run.observed.frames[0].ranges[7] = kInf;
  const auto truth = only_true_line(run);

  const double h = 1e-6;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 41; ++i) {
    if (i == 7) continue;
    const double phi = kFan.angle(i);
    const double r = range_to(kWall.rho, kWall.alpha, phi);
    const Eigen::Vector2d g(
        (range_to(kWall.rho + h, kWall.alpha, phi) - range_to(kWall.rho - h, kWall.alpha, phi)) / (2 * h),
        (range_to(kWall.rho, kWall.alpha + h, phi) - range_to(kWall.rho, kWall.alpha - h, phi)) / (2 * h));
    const double swing =
        (range_to(kWall.rho, kWall.alpha, phi + h) - range_to(kWall.rho, kWall.alpha, phi - h)) / (2 * h);
    const double variance = 0.02 * 0.02 + 0.0001 * r * r + 0.01 * 0.01 / 12 + std::pow(swing * radians(0.1), 2);
    information += g * g.transpose() / variance;
  }
  const Vec2 middle = truth.segment.midpoint();
  Eigen::Matrix2d jacobian;
  jacobian.col(0) =
      (displacement(kWall.rho + h, kWall.alpha, middle) - displacement(kWall.rho - h, kWall.alpha, middle)) / (2 * h);
  jacobian.col(1) =
      (displacement(kWall.rho, kWall.alpha + h, middle) - displacement(kWall.rho, kWall.alpha - h, middle)) / (2 * h);
  const Eigen::Matrix2d expected = jacobian * information.inverse() * jacobian.transpose();

  const auto bound = line_bound(run.observed.scan(0), truth);
  ASSERT_TRUE(bound.has_value());
  EXPECT_LT((*bound - expected).norm(), 1e-6 * expected.norm());
  EXPECT_NEAR((*bound)(0, 0), expected(0, 0), 1e-6 * expected(0, 0));
  EXPECT_NEAR((*bound)(1, 1), expected(1, 1), 1e-6 * expected(1, 1));
}

TEST(LineBound, OfAWallStraightAheadIsThatOfTheMeanOfItsReadings) {
  // For beams close to the normal the offset is the mean of n readings, so its variance is sigma^2 / n.
  SensorNoise noise;
  noise.sigma_m = 0.01;
  MadeUpRun run = make_run(ScanGeometry(radians(-1), radians(0.1), 21), {{"w", {{30, -9}, {30, 9}}}});
  run.observed.sensor.noise = noise;
  cast_frame(run, {});
  const auto bound = line_bound(run.observed.scan(0), only_true_line(run));
  ASSERT_TRUE(bound.has_value());
  EXPECT_NEAR((*bound)(0, 0), 0.01 * 0.01 / 21, 1e-3 * 0.01 * 0.01 / 21);
}

TEST(LineBound, DoesNotExistForASensorWithoutNoise) {
  const MadeUpRun run = fan({});
  EXPECT_FALSE(line_bound(run.observed.scan(0), only_true_line(run)).has_value());
  const auto rows = evaluate("efficiency", run);
  for (const char* metric : {"efficiency_offset", "efficiency_angle", "bound_offset", "nees"})
    expect_undefined(rows, metric);
}

/// Maximum likelihood of (rho, alpha) for Gaussian noise of one size along the beams: Gauss-Newton on the ranges.
PolarLine most_likely_line(const std::vector<double>& ranges) {
  Eigen::Vector2d x(kWall.rho, kWall.alpha);
  for (int step = 0; step < 6; ++step) {
    Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (int i = 0; i < kFan.beams(); ++i) {
      const double delta = kFan.angle(i) - x[1];
      const Eigen::Vector2d g(1 / std::cos(delta), -x[0] * std::sin(delta) / std::pow(std::cos(delta), 2));
      a += g * g.transpose();
      b += g * (ranges[as_index(i)] - x[0] / std::cos(delta));
    }
    x += a.inverse() * b;
  }
  return canonical(x[0], x[1]);
}

TEST(Efficiency, OfMaximumLikelihoodIsOneAndTheBoundIsItsHonestCovariance) {
  SensorNoise noise;
  noise.sigma_m = 0.02;
  constexpr int kTrials = 1500;
  MadeUpRun run = fan(noise, kTrials);
  const auto truth = only_true_line(run);
  const auto bound = line_bound(run.observed.scan(0), truth);
  ASSERT_TRUE(bound.has_value());
  Eigen::Matrix2d sample = Eigen::Matrix2d::Zero();
  for (std::size_t f = 0; f < kTrials; ++f) {
    CounterRng rng(11, RngStream::range, static_cast<std::uint32_t>(f));
    for (double& r : run.observed.frames[f].ranges) r += 0.02 * rng.normal();
    LineFeature line;
    line.line = most_likely_line(run.observed.frames[f].ranges);
    const Eigen::Vector2d e = displacement(line.line.rho, line.line.alpha, truth.segment.midpoint());
    sample += e * e.transpose() / kTrials;
    // The line's midpoint is the true one's, moved onto the line.
    const Vec2 shift = line.line.signed_distance(truth.segment.midpoint()) * line.line.normal();
    line.segment = {truth.segment.a + shift, truth.segment.b + shift};
    line.covariance = *bound;
    add_line(run, f, line, {});
  }
  // Five standard deviations of a variance from n samples: 5 sqrt(2 / n).
  const double tolerance = 5 * std::sqrt(2.0 / kTrials);
  EXPECT_NEAR(sample(0, 0) / (*bound)(0, 0), 1, tolerance);
  EXPECT_NEAR(sample(1, 1) / (*bound)(1, 1), 1, tolerance);
  const double scale = std::sqrt((*bound)(0, 0) * (*bound)(1, 1));
  EXPECT_NEAR(sample(0, 1) / scale, (*bound)(0, 1) / scale, tolerance);

  const auto rows = evaluate("efficiency", run);
  EXPECT_NEAR(row(rows, "efficiency_offset").value, sample(0, 0) / (*bound)(0, 0), 1e-6);
  EXPECT_NEAR(row(rows, "efficiency_angle").value, sample(1, 1) / (*bound)(1, 1), 1e-6);
  const auto nees = row(rows, "nees");
  EXPECT_EQ(nees.count, kTrials);
  EXPECT_GE(nees.value, *nees.ci_low);
  EXPECT_LE(nees.value, *nees.ci_high);
  EXPECT_LT(*nees.ci_high - *nees.ci_low, 0.25);
}

TEST(Efficiency, IsTheMeanSquaredErrorOverTheMeanBound) {
  SensorNoise noise;
  noise.sigma_m = 0.02;
  MadeUpRun run = fan(noise, 2);
  const auto truth = only_true_line(run);
  const double bound = (*line_bound(run.observed.scan(0), truth))(0, 0);
  for (const std::size_t f : {0, 1}) {
    const Vec2 shift = (f == 0 ? 0.03 : -0.01) * kWall.normal();
    add_line(run, f, line_between(truth.segment.a + shift, truth.segment.b + shift), {});
  }
  const auto rows = evaluate("efficiency", run);
  const auto offset = row(rows, "efficiency_offset");
  EXPECT_NEAR(offset.value, (0.0009 + 0.0001) / 2 / bound, 1e-6);
  EXPECT_EQ(offset.count, 2);
  // Squared errors 9e-4 and 1e-4: mean 5e-4, deviation 4e-4 (n) or 4e-4 sqrt 2 (n - 1), of the mean 4e-4.
  EXPECT_NEAR(*offset.ci_high - offset.value, 1.96 * 4e-4 / bound, 1e-6);
  EXPECT_NEAR(row(rows, "efficiency_angle").value, 0.0, 1e-12);
  EXPECT_NEAR(row(rows, "bound_offset").value, std::sqrt(bound), 1e-12);
  expect_undefined(rows, "nees");
}

TEST(Efficiency, LinesOfTooFewBeamsDoNotCount) {
  SensorNoise noise;
  noise.sigma_m = 0.02;
  MadeUpRun run = fan(noise);
  find_all_lines(run, 0);
  EXPECT_EQ(row(evaluate("efficiency", run, {{"min_beams", std::int64_t{41}}}), "efficiency_offset").count, 1);
  expect_undefined(evaluate("efficiency", run, {{"min_beams", std::int64_t{42}}}), "efficiency_offset");
}

TEST(Nees, TakesTheErrorAtTheFoundLinesMidpointWithTheSignsOfItsNormal) {
  // The wall is x = 2. The found line is rotated counter-clockwise by atan(0.01) about (2, 0): at its midpoint, y = 1,
  // it is at x = 2 - 0.01, which is 0.01 cos(angle) nearer along its normal.
  SensorNoise noise;
  noise.sigma_m = 0.02;
  MadeUpRun run = make_run(ScanGeometry(radians(-45), radians(1), 91), {{"wall", {{2, -5}, {2, 5}}}});
  run.observed.sensor.noise = noise;
  cast_frame(run, {});
  LineFeature& line = add_line(run, 0, line_between({2 - 0.005, 0.5}, {2 - 0.015, 1.5}), {});
  Eigen::Matrix2d c;
  c << 4e-4, -1e-4, -1e-4, 1e-4;
  line.covariance = c;
  const double angle = std::atan(0.01);
  // Inverse of [[4, -1], [-1, 1]] is [[1, 1], [1, 4]] / 3. The error across the wall seen from the found line's
  // midpoint is 0.01 along the wall's normal.
  const double o = -0.01;
  const double expected = 1e4 / 3 * (o * o + 2 * o * angle + 4 * angle * angle);
  const auto nees = row(evaluate("efficiency", run), "nees");
  EXPECT_NEAR(nees.value, expected, 1e-9);
  EXPECT_NEAR(*nees.ci_low, -2 * std::log(0.975), 1e-6);
  EXPECT_NEAR(*nees.ci_high, -2 * std::log(0.025), 1e-6);
}

TEST(Nees, IsFiniteAndRightWhenTheLinePassesTheSensorOnTheOtherSide) {
  // The wall y = 0.01 seen by beams of 0.2 to 1.2 deg; the line found is y = -0.01, whose normal points down.
  MadeUpRun run = make_run(ScanGeometry(radians(0.2), radians(0.05), 21), {{"wall", {{5, 0.01}, {0.1, 0.01}}}});
  cast_frame(run, {});
  LineFeature& line = add_line(run, 0, line_between({2.5, -0.01}, {0.5, -0.01}), {});
  Eigen::Matrix2d c;
  c << 1e-4, 0, 0, 1e-4;
  line.covariance = c;
  EXPECT_NEAR(row(evaluate("efficiency", run), "nees").value, 0.02 * 0.02 / 1e-4, 1e-9);
}

TEST(Efficiency, NeedsTruthAndGivesAllRowsForAnEmptyRun) {
  const MadeUpRun run = make_run(kFan, {{"wall", {{2, -5}, {2, 5}}}});
  EXPECT_FALSE(family("efficiency")->applies(run.input_without_truth()));
  const auto rows = evaluate("efficiency", run);
  EXPECT_EQ(rows.size(), 5u);
  for (const auto& r : rows) expect_undefined(rows, r.metric);
}

TEST(Efficiency, WritesMatchesOnRequest) {
  SensorNoise noise;
  noise.sigma_m = 0.02;
  MadeUpRun run = fan(noise, 2);
  const auto truth = only_true_line(run);
  const Eigen::Matrix2d bound = *line_bound(run.observed.scan(0), truth);
  const Vec2 shift = 0.03 * kWall.normal();
  add_line(run, 1, line_between({0, 0}, {0.1, 0}), {});  // matches nothing
  add_line(run, 1, line_between(truth.segment.a + shift, truth.segment.b + shift), {});
  EXPECT_TRUE(family("efficiency")->tables(run.input()).empty());

  const auto tables = family("efficiency", {{"matches", true}})->tables(run.input());
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].name, "matches");
  EXPECT_EQ(family("efficiency")->table_names(), std::vector<std::string>{"matches"});
  ASSERT_EQ(tables[0].rows.size(), 1u);
  ASSERT_EQ(tables[0].rows[0].size(), tables[0].columns.size());
  const auto value = [&](std::string_view column) {
    const auto found = std::ranges::find(tables[0].columns, column);
    EXPECT_NE(found, tables[0].columns.end()) << column;
    return tables[0].rows[0][as_index(found - tables[0].columns.begin())];
  };
  EXPECT_EQ(value("frame"), 1);
  EXPECT_EQ(value("line"), 1);
  EXPECT_EQ(value("first_beam"), 0);
  EXPECT_EQ(value("last_beam"), 40);
  EXPECT_EQ(value("beams"), 41);
  EXPECT_DOUBLE_EQ(value("range_m"), truth.segment.midpoint().norm());
  EXPECT_DOUBLE_EQ(value("length_m"), truth.segment.length());
  EXPECT_NEAR(value("offset_m"), 0.03, 1e-12);
  EXPECT_NEAR(value("angle_rad"), 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(value("bound_offset_m"), std::sqrt(bound(0, 0)));
  EXPECT_DOUBLE_EQ(value("bound_angle_rad"), std::sqrt(bound(1, 1)));
}

}  // namespace
}  // namespace scanbench::test
