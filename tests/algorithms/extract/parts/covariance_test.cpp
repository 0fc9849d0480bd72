// Covariances of total-least-squares lines: against brute-force propagation, and against errors over many scans.
#include "algorithms/extract/parts/covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/index.hpp"
#include "tests/support/extraction.hpp"

namespace scanbench {
namespace {

using extract::checked_covariance;
using extract::tls_covariance;
using support::cast;
using support::fan_sensor;
using support::OwnedScan;
using support::with_noise;

// A slanted wall across the whole view of a 90-degree fan, 1.5 m away at its nearest, hit at up to 75 degrees from its
// normal.
const Segment kWall{{3, -8}, {1, 8}};

SensorModel sensor_of(double sigma_m, double sigma_relative, double quantum_m, double bearing_sigma_rad) {
  SensorModel sensor = fan_sensor(61, radians(90));
  sensor.noise.sigma_m = sigma_m;
  sensor.noise.sigma_relative = sigma_relative;
  sensor.noise.quantum_m = quantum_m;
  sensor.noise.bearing_sigma_rad = bearing_sigma_rad;
  return sensor;
}

std::vector<int> all_of(std::size_t n) {
  std::vector<int> indices(n);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

// Offset of a line at a point along the normal of `reference`, and its angle against it.
Eigen::Vector2d difference(const LineFit& line, const PolarLine& reference, const Vec2& at) {
  const Vec2 m = reference.normal();
  const double side = line.normal.dot(m) < 0 ? -1.0 : 1.0;
  const Vec2 n = side * line.normal;
  return {side * line.offset - n.dot(at), std::atan2(cross(m, n), m.dot(n))};
}

TEST(TlsCovariance, IsWhatRefitsToReadingsMovedOneByOneGive) {
  const double step = 1e-6;
  for (const auto& sensor : {sensor_of(0.02, 0, 0, 0), sensor_of(0.01, 0.01, 0.01, 0), sensor_of(0.005, 0, 0, 0.003)}) {
    const OwnedScan scan = cast(sensor, {kWall});
    const ScanPoints points = valid_points(scan.view());
    ASSERT_EQ(points.size(), 61U);
    const PolarLine line = fit_line(points.points).polar();
    const Vec2 at = kWall.a + 0.3 * (kWall.b - kWall.a);
    const auto found = tls_covariance(scan.view(), points, all_of(61), line, at);
    ASSERT_TRUE(found);
    Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < 61; ++i) {
      const double r = scan.ranges[i];
      const Vec2 u = sensor.geometry.direction(static_cast<int>(i));
      const auto derivative = [&](const Vec2& by) {
        const auto moved = [&](double amount) {
          std::vector<Vec2> p = points.points;
          p[i] += amount * by;
          return difference(fit_line(p), line, at);
        };
        return Eigen::Vector2d((moved(step) - moved(-step)) / (2 * step));
      };
      const Eigen::Vector2d along = derivative(u), across = derivative(r * perpendicular(u));
      expected += std::pow(sensor.noise.range_sigma(r), 2) * along * along.transpose() +
                  std::pow(sensor.noise.bearing_sigma_rad, 2) * across * across.transpose();
    }
    EXPECT_LT((*found - expected).norm(), 1e-6 * expected.norm()) << *found << "\n\n" << expected;
  }
}

TEST(TlsCovariance, IsAbsentWithoutStatedNoiseAndWhereTheNoiseHidesTheDirection) {
  const auto of_run = [](double sigma_m, int first, int last) {
    const OwnedScan scan = cast(sensor_of(sigma_m, 0, 0, 0), {kWall});
    const ScanPoints points = valid_points(scan.view());
    std::vector<int> support;
    for (int i = first; i <= last; ++i) support.push_back(i);
    return tls_covariance(scan.view(), points, support, line_through(kWall.a, kWall.b), kWall.midpoint());
  };
  EXPECT_TRUE(of_run(0.01, 0, 60));
  EXPECT_FALSE(of_run(0.0, 0, 60));
  EXPECT_FALSE(of_run(0.5, 28, 32));  // 0.2 m of wall, half a metre of noise
  EXPECT_FALSE(of_run(0.01, 30, 30));
  EXPECT_FALSE(of_run(0.01, 30, 29));
}

using Estimate = decltype(&tls_covariance);

/// Mean normalised squared error of lines through two walls, the second three standard deviations behind the first,
/// against the first wall. Lines without a covariance do not count.
double nees_over_a_step(Estimate estimate) {
  const PolarLine truth = line_through(kWall.a, kWall.b);
  const SensorModel sensor = sensor_of(0.02, 0, 0, 0);
  double sum = 0.0;
  int lines = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const OwnedScan scan = with_noise(cast(sensor, {kWall}), 0.02, seed);
    ScanPoints points = valid_points(scan.view());
    for (std::size_t i = 35; i < points.size(); ++i) points.points[i] += 0.06 * truth.normal();
    const LineFit fit = fit_line(points.points);
    const Vec2 at = fit.project(kWall.midpoint());
    const auto covariance = estimate(scan.view(), points, all_of(points.size()), fit.polar(), at);
    if (!covariance) continue;
    const double side = fit.polar().normal().dot(truth.normal()) < 0 ? -1.0 : 1.0;
    const Eigen::Vector2d e(side * truth.signed_distance(at), difference(fit, truth, at)[1]);
    sum += e.dot(covariance->inverse() * e);
    ++lines;
  }
  EXPECT_GE(lines, 180);
  return sum / lines;
}

TEST(CheckedCovariance, IncludesMostOfTheErrorOfALineOverTwoWalls) {
  const double by_noise = nees_over_a_step(tls_covariance), checked = nees_over_a_step(checked_covariance);
  EXPECT_GT(by_noise, 20.0);
  EXPECT_LT(checked, 0.25 * by_noise);
}

TEST(CheckedCovariance, IsNeverSmallerThanThatOfTheNoise) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const OwnedScan scan = with_noise(cast(sensor_of(0.02, 0, 0, 0), {kWall}), 0.02, seed);
    const ScanPoints points = valid_points(scan.view());
    const PolarLine line = fit_line(points.points).polar();
    const auto by_noise = tls_covariance(scan.view(), points, all_of(61), line, kWall.midpoint());
    const auto checked = checked_covariance(scan.view(), points, all_of(61), line, kWall.midpoint());
    ASSERT_TRUE(by_noise && checked);
    const Eigen::Vector2d excess = Eigen::Matrix2d(*checked - *by_noise).selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GE(excess[0], -1e-12 * by_noise->norm());
  }
}

// The extractors that state covariances: those that admit points by the sensor's noise.
const std::vector<std::string> kSure = {"em", "hough", "incremental", "optimal", "ransac", "split_and_merge"};

class SureExtractor : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SureExtractor, ::testing::ValuesIn(kSure), [](const auto& test) { return test.param; });

// Normalised squared errors of N lines sum up to chi-square with 2 N degrees of freedom: mean 2 N, variance 4 N. Where
// a covariance is the larger of two estimates, it is cautious on a wall without faults.
TEST_P(SureExtractor, ErrorsOnASingleWallAreAsLargeAsItsCovarianceSays) {
  constexpr int kScans = 400;
  const PolarLine truth = line_through(kWall.a, kWall.b);
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    const OwnedScan scan = with_noise(cast(fan_sensor(181, radians(90)), {kWall}), 0.02, seed);
    const ScanLines lines = support::extract(GetParam(), scan);
    ASSERT_EQ(lines.lines.size(), 1U) << "seed " << seed;
    const LineFeature& f = lines.lines[0];
    ASSERT_TRUE(f.covariance);
    const LineFit found{.normal = f.line.normal(), .offset = f.line.rho};
    const Vec2 at = f.segment.midpoint();
    const Vec2 n = truth.normal();
    const Eigen::Vector2d e(n.dot(at) - truth.rho, difference(found, truth, at)[1]);
    sum += e.dot(f.covariance->inverse() * e);
  }
  const double chance = 1.96 * 2.0 / std::sqrt(kScans);
  EXPECT_LT(sum / kScans, 2.0 + chance);
  EXPECT_GT(sum / kScans, GetParam() == "optimal" ? 2.0 - chance : 1.4);
}

// In a room an extractor admits points of the next wall at a corner. Without a look at the ends of the lines the mean
// is 3 to 8.
TEST_P(SureExtractor, ErrorsInRoomsAreNotMuchLargerThanItsCovarianceSays) {
  double sum = 0.0;
  int lines = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto walls = support::random_room(seed);
    const OwnedScan scan = with_noise(cast(support::ring_sensor(361), walls), 0.02, seed);
    const ScanLines found = support::extract(GetParam(), scan);
    for (std::size_t k = 0; k < found.lines.size(); ++k) {
      const LineFeature& f = found.lines[k];
      std::vector<int> votes(walls.size(), 0);
      for (std::size_t i = 0; i < found.labels.size(); ++i)
        if (found.labels[i] == static_cast<int>(k)) ++votes[as_index(scan.ids[i])];
      const auto most = std::ranges::max_element(votes);
      if (f.points < 20 || 10 * *most < 8 * f.points || !f.covariance) continue;
      const Segment& wall = walls[static_cast<std::size_t>(most - votes.begin())];
      const PolarLine truth = line_through(wall.a, wall.b);
      const Vec2 at = f.segment.midpoint();
      const Eigen::Vector2d d = difference(LineFit{.normal = f.line.normal(), .offset = f.line.rho}, truth, at);
      const double side = f.line.normal().dot(truth.normal()) < 0 ? -1.0 : 1.0;
      const Eigen::Vector2d e(-side * truth.signed_distance(at), d[1]);
      sum += e.dot(f.covariance->inverse() * e);
      ++lines;
    }
  }
  ASSERT_GE(lines, 200);
  EXPECT_LT(sum / lines, 2.8);
  EXPECT_GT(sum / lines, 1.4);
}

TEST(CovarianceOfExtractors, IsAbsentWherePointsAreNotHeldAgainstTheNoise) {
  const OwnedScan scan = with_noise(cast(fan_sensor(181, radians(90)), {kWall}), 0.01, 1);
  for (const std::string name : {"sef", "iepf", "line_tracking", "kovesi", "smf", "fuzzy_lines", "line_regression"})
    for (const LineFeature& f : support::extract(name, scan).lines) EXPECT_FALSE(f.covariance) << name;
}

TEST(CovarianceOfExtractors, IsAbsentForASensorWithoutStatedNoise) {
  const OwnedScan scan = cast(fan_sensor(181, radians(90)), {kWall});
  for (const std::string& name : kSure) {
    if (name == "optimal") continue;  // assumes a least noise of its own
    const ScanLines lines = support::extract(name, scan);
    ASSERT_FALSE(lines.lines.empty()) << name;
    for (const LineFeature& f : lines.lines) EXPECT_FALSE(f.covariance) << name;
  }
}

}  // namespace
}  // namespace scanbench
