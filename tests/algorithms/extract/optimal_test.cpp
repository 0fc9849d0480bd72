// The optimal extractor: exactness of its dynamic programme, the maximum-likelihood line and its covariance, and the
// results on scans.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "algorithms/extract/optimal/segmentation.hpp"
#include "algorithms/extract/parts/beam_kernels.hpp"
#include "algorithms/extract/parts/beam_line.hpp"
#include "core/isa.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Points = std::vector<SegmentationPoint>;

Trace silent;

// Points on a few random walls with some clutter and, sometimes, gaps that a line may or may not cross.
Points random_points(std::uint32_t seed, int n, double step_rad = 0.05) {
  CounterRng rng(seed, RngStream::pose);
  Points points;
  double rho = 2, alpha = 0.3;
  for (int i = 0; i < n; ++i) {
    if (rng.uniform() < 3.0 / n + 0.1) {
      rho = 1 + 2 * rng.uniform();
      alpha = i * step_rad + 2 * (rng.uniform() - 0.5);
    }
    const double sigma = 0.02 + 0.05 * rng.uniform();
    double r = std::max(rho / std::max(std::cos(i * step_rad - alpha), 0.2) + sigma * rng.normal(), 0.1);
    if (rng.uniform() < 0.1) r = 0.2 + 5 * rng.uniform();
    const double gap = rng.uniform() < 0.1 ? (rng.uniform() < 0.5 ? 2.0 : kInfinity) : 0.0;
    points.push_back({.direction = {std::cos(i * step_rad), std::sin(i * step_rad)},
                      .inverse_range = 1 / r,
                      .weight = std::pow(r * r / sigma, 2),
                      .line_cost = std::log(sigma * std::sqrt(kTwoPi)),
                      .clutter_cost = std::log(10.0),
                      .gap_cost = gap});
  }
  return points;
}

// Half the weighted sum of squared residuals of least squares, by a solver that does not use the programme's sums.
double misfit(const Points& points, int first, int last) {
  const int n = last - first + 1;
  if (n <= 2) return 0.0;
  Eigen::MatrixX2d a(n, 2);
  Eigen::VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    const SegmentationPoint& p = points[static_cast<std::size_t>(first + i)];
    a.row(i) = std::sqrt(p.weight) * p.direction.transpose();
    b(i) = std::sqrt(p.weight) * p.inverse_range;
  }
  return 0.5 * (a * a.colPivHouseholderQr().solve(b) - b).squaredNorm();
}

double cost_of_line(const Points& points, int first, int last) {
  double cost = misfit(points, first, last);
  for (int i = first; i <= last; ++i) {
    cost += points[static_cast<std::size_t>(i)].line_cost;
    if (i > first) cost += points[static_cast<std::size_t>(i)].gap_cost;
  }
  return cost;
}

// The least cost over all cuts, with exactly or at most as many lines as allowed, by trying them all.
double brute_force(const Points& points, int first, int lines_left, const std::function<double(int)>& cost_of_count) {
  if (first == static_cast<int>(points.size())) return 0.0;
  double best =
      points[static_cast<std::size_t>(first)].clutter_cost + brute_force(points, first + 1, lines_left, cost_of_count);
  if (lines_left > 0)
    for (int last = first; last < static_cast<int>(points.size()); ++last) {
      const double line = cost_of_line(points, first, last) + cost_of_count(last - first + 1);
      if (line < kInfinity) best = std::min(best, line + brute_force(points, last + 1, lines_left - 1, cost_of_count));
    }
  return best;
}

double cost_of_cut(const Points& points, const Segmentation& cut, const std::function<double(int)>& cost_of_count) {
  double cost = 0;
  int next = 0;
  for (const PointRun& run : cut.lines) {
    for (; next < run.first; ++next) cost += points[static_cast<std::size_t>(next)].clutter_cost;
    cost += cost_of_line(points, run.first, run.last) + cost_of_count(run.size());
    next = run.last + 1;
  }
  for (; next < static_cast<int>(points.size()); ++next) cost += points[static_cast<std::size_t>(next)].clutter_cost;
  return cost;
}

TEST(OptimalSegmentation, CostsAsLittleAsTheBestOfAllCutsOfAFewBeams) {
  for (std::uint32_t seed = 0; seed < 60; ++seed)
    for (const double base : {0.5, 3.0, 8.0}) {
      const Points points = random_points(seed, 1 + static_cast<int>(seed % 12), seed % 2 ? 0.05 : 0.005);
      const auto count_cost = [&](int n) { return base + std::log(n); };
      const Segmentation cut = optimal_segmentation(points, {base});
      EXPECT_NEAR(cut.cost, brute_force(points, 0, 99, count_cost), 1e-6) << "seed " << seed;
      EXPECT_NEAR(cut.cost, cost_of_cut(points, cut, count_cost), 1e-6) << "seed " << seed;
    }
}

TEST(OptimalSegmentation, CostsAsLittleAsTheBestCutIntoAtMostSoManyLines) {
  for (std::uint32_t seed = 0; seed < 30; ++seed)
    for (const int lines : {0, 1, 2, 4}) {
      const Points points = random_points(seed, 1 + static_cast<int>(seed % 11));
      const auto none = [](int) { return 0.0; };
      const Segmentation cut = optimal_segmentation_at_most(points, lines);
      EXPECT_NEAR(cut.cost, brute_force(points, 0, lines, none), 1e-6);
      EXPECT_LE(static_cast<int>(cut.lines.size()), lines);
      EXPECT_NEAR(cut.cost, cost_of_cut(points, cut, none), 1e-6);
    }
}

// The recursion without pruning, groups or anchors.
double plain_recursion(const Points& points, double base) {
  const int n = static_cast<int>(points.size());
  std::vector<double> f(points.size() + 1, 0.0);
  for (int t = 1; t <= n; ++t) {
    f[static_cast<std::size_t>(t)] =
        f[static_cast<std::size_t>(t - 1)] + points[static_cast<std::size_t>(t - 1)].clutter_cost;
    for (int s = 0; s < t; ++s) {
      const double cost = f[static_cast<std::size_t>(s)] + cost_of_line(points, s, t - 1) + base + std::log(t - s);
      if (cost < kInfinity) f[static_cast<std::size_t>(t)] = std::min(f[static_cast<std::size_t>(t)], cost);
    }
  }
  return f.back();
}

// Walls that differ little, so that many cuts cost nearly the same and pruning decides between them.
Points gentle_points(std::uint32_t seed, int n) {
  CounterRng rng(seed, RngStream::pose);
  Points points;
  const double sigma = 0.03;
  double rho = 2, alpha = 0.3;
  for (int i = 0; i < n; ++i) {
    if (rng.uniform() < 0.1) {
      rho += 0.04 * rng.normal();
      alpha += 0.1 * rng.normal();
    }
    const double r = std::max(rho, 0.5) / std::max(std::cos(i * 0.01 - alpha), 0.2) + sigma * rng.normal();
    points.push_back({.direction = {std::cos(i * 0.01), std::sin(i * 0.01)},
                      .inverse_range = 1 / r,
                      .weight = std::pow(r * r / sigma, 2),
                      .line_cost = std::log(sigma * std::sqrt(kTwoPi)),
                      .clutter_cost = std::log(10.0),
                      .gap_cost = 0.0});
  }
  return points;
}

TEST(OptimalSegmentation, LosesNothingByPruning) {
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    for (const double base : {0.2, 2.0, 10.0}) {
      const Points points = random_points(seed, 80, seed % 2 ? 0.01 : 0.03);
      EXPECT_NEAR(optimal_segmentation(points, {base}).cost, plain_recursion(points, base), 1e-5) << "seed " << seed;
      const Points gentle = gentle_points(seed, 80);
      EXPECT_NEAR(optimal_segmentation(gentle, {base}).cost, plain_recursion(gentle, base), 1e-5) << "seed " << seed;
    }
}

TEST(OptimalSegmentation, LosesNothingByPruningOfManyGroupsOfStarts) {
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    const Points gentle = gentle_points(seed, 240);
    EXPECT_NEAR(optimal_segmentation(gentle, {2.0}).cost, plain_recursion(gentle, 2.0), 1e-5) << "seed " << seed;
    const Points random = random_points(seed, 240, 0.01);
    EXPECT_NEAR(optimal_segmentation(random, {2.0}).cost, plain_recursion(random, 2.0), 1e-5) << "seed " << seed;
  }
}

TEST(OptimalSegmentation, OfNothingIsNothingAndOfOnePointIsClutterOrALine) {
  EXPECT_TRUE(optimal_segmentation(Points{}, {1.0}).lines.empty());
  EXPECT_TRUE(optimal_segmentation_at_most(Points{}, 3).lines.empty());
  const Points one = random_points(1, 1);
  EXPECT_TRUE(optimal_segmentation(one, {100.0}).lines.empty());
  EXPECT_EQ(optimal_segmentation(one, {-100.0}).lines.size(), 1u);
}

TEST(OptimalSegmentation, AtBlocksOfPointsIsNoBetterThanAtEveryPoint) {
  const Points points = random_points(3, 200, 0.02);
  const Segmentation fine = optimal_segmentation(points, {10.0});
  const Segmentation coarse = optimal_segmentation(points, {10.0}, 50);
  EXPECT_GE(coarse.cost, fine.cost - 1e-6);
  EXPECT_NEAR(coarse.cost, cost_of_cut(points, coarse, [](int n) { return 10.0 + std::log(n); }), 1e-6);
}

// ---- the line

SensorNoise noise_of(double sigma, double relative = 0.0, double bearing = 0.0) {
  SensorNoise noise;
  noise.sigma_m = sigma;
  noise.sigma_relative = relative;
  noise.bearing_sigma_rad = bearing;
  return noise;
}

std::vector<BeamReading> wall(double rho, double alpha, double from, double to, int n, double sigma,
                              std::uint32_t seed) {
  std::vector<BeamReading> readings;
  for (int i = 0; i < n; ++i) {
    const double phi = from + (to - from) * i / (n - 1);
    CounterRng rng(seed, RngStream::range, 0, static_cast<std::uint32_t>(i));
    readings.push_back({{std::cos(phi), std::sin(phi)}, rho / std::cos(phi - alpha) + sigma * rng.normal()});
  }
  return readings;
}

double log_likelihood(std::span<const BeamReading> readings, double sigma, const Vec2& theta) {
  double sum = 0;
  for (const BeamReading& b : readings) sum -= 0.5 * std::pow((b.range_m - 1 / theta.dot(b.direction)) / sigma, 2);
  return sum;
}

TEST(BeamLine, HasTheGreatestLikelihood) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto readings = wall(2.0, 0.5, -0.5, 1.2, 40, 0.05, seed);
    const auto line = fit_beam_line(readings, noise_of(0.05));
    ASSERT_TRUE(line);
    Vec2 gradient = Vec2::Zero();  // of the log likelihood by theta; the range 1/(theta . d) falls by d r^2
    for (const BeamReading& b : readings) {
      const double r = 1 / line->theta.dot(b.direction);
      gradient -= (b.range_m - r) / (0.05 * 0.05) * r * r * b.direction;
    }
    // The squared distance to the maximum: below 1e-7 standard deviations, so that only last digits depend on it.
    EXPECT_LT(gradient.dot(line->information.inverse() * gradient), 1e-14);
    const double top = log_likelihood(readings, 0.05, line->theta);
    const double h = 1e-2 * line->theta.norm();
    for (const Vec2& d : {Vec2(h, 0), Vec2(-h, 0), Vec2(0, h), Vec2(0, -h)})
      EXPECT_LT(log_likelihood(readings, 0.05, line->theta + d), top);
  }
}

TEST(BeamLine, HasEqualBytesOnEveryProcessor) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has no AVX2";
  for (int n = 2; n < 30; ++n) {
    const auto readings = wall(2.0, 0.5, -0.5, 1.2, n, 0.05, static_cast<std::uint32_t>(n));
    const auto a = fit_beam_line(readings, noise_of(0.04, 0.01, 0.002), {}, Isa::baseline);
    const auto b = fit_beam_line(readings, noise_of(0.04, 0.01, 0.002), {}, Isa::v3);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->theta, b->theta);
    EXPECT_EQ(a->information, b->information);
  }
}

TEST(BeamLine, SumsAreThoseOfOneReadingAtATime) {
  SensorNoise jump = noise_of(0.03, 0.015);
  jump.relative_from_m = 2.4;
  SensorNoise rounded = noise_of(0.0);
  rounded.quantum_m = 0.01;
  for (const SensorNoise& noise : {noise_of(0.05), noise_of(0.02, 0.01, 0.004), jump, rounded, noise_of(0.0)})
    for (const int n : {2, 3, 4, 5, 31}) {
      const auto readings = wall(2.0, 0.5, -0.5, 1.2, n, 0.05, 7);
      std::array<std::vector<double>, 3> columns;
      for (auto& column : columns) column.resize(32);
      for (std::size_t i = 0; i < 32; ++i) {
        const BeamReading& b = readings[std::min(i, readings.size() - 1)];
        columns[0][i] = b.direction.x();
        columns[1][i] = b.direction.y();
        columns[2][i] = b.range_m;
      }
      const Vec2 theta(0.4, 0.3);
      const double at[] = {theta.x(), theta.y()};
      const BeamSums sums = baseline::kBeamKernels.step({columns[0].data(), columns[1].data(), columns[2].data(), n},
                                                        at, ReadingNoise(noise));
      Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
      Vec2 rhs = Vec2::Zero();
      for (const BeamReading& b : readings) {
        const double r = 1.0 / theta.dot(b.direction);
        const double s = std::max(
            std::hypot(noise.range_sigma(r), noise.bearing_sigma_rad * r * r * cross(theta, b.direction)), kLeastSigma);
        const Vec2 g = r * r / s * b.direction;  // minus the derivative of the range by theta, in sigma
        matrix += g * g.transpose();
        rhs += (r - b.range_m) / s * g;
      }
      const double tolerance = 1e-12 * matrix.norm();
      EXPECT_NEAR(sums.xx, matrix(0, 0), tolerance);
      EXPECT_NEAR(sums.xy, matrix(0, 1), tolerance);
      EXPECT_NEAR(sums.yy, matrix(1, 1), tolerance);
      EXPECT_NEAR(sums.x, rhs.x(), tolerance);
      EXPECT_NEAR(sums.y, rhs.y(), tolerance);
    }
}

TEST(BeamLine, IsExactWithoutNoise) {
  for (const double alpha : {0.0, 1.0, 3.0, -2.5})
    for (const double span : {0.05, 1.0, 2.4}) {
      const auto readings = wall(3.0, alpha, alpha - 0.3 * span, alpha + 0.6 * span, 12, 0.0, 1);
      const auto line = fit_beam_line(readings, noise_of(0.01));
      ASSERT_TRUE(line);
      const auto d =
          line_difference(canonical(line->rho(), std::atan2(line->theta.y(), line->theta.x())), {3.0, alpha});
      EXPECT_LT(d.rho, 1e-9);
      EXPECT_LT(d.alpha, 1e-9);
    }
}

TEST(BeamLine, CovarianceIsTheInverseOfTheNumericalFisherInformation) {
  const double rho = 2.0, alpha = 0.5, sigma = 0.03, relative = 0.01, bearing = 0.004;
  const auto readings = wall(rho, alpha, -0.6, 1.3, 30, 0.0, 1);
  const auto line = fit_beam_line(readings, noise_of(sigma, relative, bearing));
  ASSERT_TRUE(line);
  const Vec2 n(std::cos(alpha), std::sin(alpha));
  const Vec2 point = rho * n + 0.4 * perpendicular(n);
  // Parameters (offset at the point, angle): derivatives of the ranges by differences.
  const auto range = [&](double offset, double turn, const Vec2& beam) {
    const Vec2 m(std::cos(alpha + turn), std::sin(alpha + turn));
    return (m.dot(point) + offset) / m.dot(beam);
  };
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  const double h = 1e-5;
  for (const BeamReading& b : readings) {
    const Eigen::Vector2d g((range(h, 0, b.direction) - range(-h, 0, b.direction)) / (2 * h),
                            (range(0, h, b.direction) - range(0, -h, b.direction)) / (2 * h));
    const double r = range(0, 0, b.direction);
    const double phi = std::atan2(b.direction.y(), b.direction.x());
    const double slope = r * std::tan(phi - alpha);
    const double variance = sigma * sigma + std::pow(relative * r, 2) + std::pow(bearing * slope, 2);
    information += g * g.transpose() / variance;
  }
  const Eigen::Matrix2d expected = information.inverse();
  EXPECT_LT((line_covariance(*line, point) - expected).norm(), 1e-6 * expected.norm());
}

TEST(BeamLine, ErrorsAreAsLargeAsItsCovarianceSays) {
  // Normalised squared errors of N lines: chi-square with 2 N degrees of freedom.
  const int trials = 2000;
  const double rho = 2.0, alpha = 0.4;
  double sum = 0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const auto readings = wall(rho, alpha, -0.7, 1.4, 35, 0.03, seed);
    const auto line = fit_beam_line(readings, noise_of(0.03));
    ASSERT_TRUE(line);
    const Vec2 n(std::cos(alpha), std::sin(alpha));
    const double turn = wrap_angle(std::atan2(line->theta.y(), line->theta.x()) - alpha);
    const Vec2 on_wall = rho * n + 0.3 * perpendicular(n);
    const Vec2 point = on_wall - (line->normal().dot(on_wall) - line->rho()) * line->normal();
    const Eigen::Vector2d e(line->rho() - line->normal().dot(on_wall), turn);
    sum += e.dot(line_covariance(*line, point).inverse() * e);
  }
  EXPECT_NEAR(sum / trials, 2.0, 3.3 * 2.0 / std::sqrt(trials));
}

TEST(BeamLine, DoesNotExistForTooFewOrImpossibleReadings) {
  EXPECT_FALSE(fit_beam_line({}, noise_of(0.01)));
  const BeamReading one{{1, 0}, 2.0};
  EXPECT_FALSE(fit_beam_line(std::vector{one}, noise_of(0.01)));
  EXPECT_FALSE(fit_beam_line(std::vector{one, one}, noise_of(0.01)));
}

// ---- the module

SensorModel sensor(int beams, double sigma) {
  SensorModel s;
  s.geometry = ScanGeometry(radians(-135), radians(270.0) / std::max(beams - 1, 1), beams);
  s.noise.sigma_m = sigma;
  return s;
}

// Range to the inside of an axis-parallel room and to a box in it.
double room(const Vec2& origin, const Vec2& d) {
  double best = kInfinity;
  for (const auto& b : {std::array{-3.0, -2.0, 5.0, 4.0}, std::array{2.0, -1.0, 3.0, 0.5}})
    for (const std::size_t axis : {0u, 1u})
      for (const std::size_t side : {0u, 2u}) {
        const double t = (b[axis + side] - origin[static_cast<int>(axis)]) / d[static_cast<int>(axis)];
        const double across = origin[static_cast<int>(1 - axis)] + t * d[static_cast<int>(1 - axis)];
        if (t > 0 && across >= b[1 - axis] && across <= b[3 - axis]) best = std::min(best, t);
      }
  return best;
}

std::vector<double> room_scan(const SensorModel& s, std::uint32_t seed) {
  std::vector<double> ranges;
  for (int i = 0; i < s.geometry.beams(); ++i) {
    CounterRng rng(seed, RngStream::range, 0, static_cast<std::uint32_t>(i));
    ranges.push_back(room({0.1, 0.2}, s.geometry.direction(i)) + s.noise.sigma_m * rng.normal());
  }
  return ranges;
}

TEST(OptimalModule, FindsEachWallOfARoomOnceAndTheBox) {
  // Only the near face of the box is visible, from y = -1 to 0.5. Its shadow on the wall x = 5 goes from y = 0.2 - 1.2
  // * 4.9/1.9 = -2.9, beyond the corner, to 0.97, so one piece of that wall is visible.
  const auto module = Registry<LineExtractor>::make("optimal");
  for (const double sigma : {0.005, 0.02, 0.05})
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
      const SensorModel s = sensor(451, sigma);
      const std::vector<double> ranges = room_scan(s, seed);
      const ScanLines out = module->extract({s, ranges}, silent);
      int x5 = 0, x2 = 0, y4 = 0, yneg = 0;
      for (const LineFeature& line : out.lines) {
        const auto is = [&](const PolarLine& l) {
          const auto d = line_difference(line.line, l);
          return d.rho < 0.1 + 3 * sigma && d.alpha < radians(5);
        };
        ASSERT_TRUE(line.covariance);
        EXPECT_GT(line.covariance->determinant(), 0.0);
        EXPECT_NEAR(line.rms_m, sigma, sigma);
        EXPECT_GT(cross(line.segment.a, line.segment.b), 0.0);
        x5 += is({4.9, 0});
        x2 += is({1.9, 0});
        y4 += is({3.8, kPi / 2});
        yneg += is({2.2, -kPi / 2});
      }
      EXPECT_EQ(x2, 1);
      EXPECT_EQ(x5, 1);
      EXPECT_EQ(y4, 1);
      EXPECT_EQ(yneg, 1);
    }
}

TEST(OptimalModule, SkipsSpuriousReturnsOnlyIfTheSensorGivesThem) {
  SensorModel s = sensor(181, 0.01);
  s.geometry = ScanGeometry(radians(-45), radians(0.5), 181);
  std::vector<double> ranges;
  for (int i = 0; i < 181; ++i) ranges.push_back(3.0 / s.geometry.direction(i).x());
  ranges[60] = 1.0;
  ranges[120] = 2.0;
  ranges[121] = 0.7;
  const auto module = Registry<LineExtractor>::make("optimal");
  EXPECT_EQ(module->extract({s, ranges}, silent).lines.size(), 3u);
  s.noise.spurious_probability = 0.02;
  const ScanLines out = module->extract({s, ranges}, silent);
  ASSERT_EQ(out.lines.size(), 1u);
  EXPECT_EQ(out.lines[0].points, 178);
  EXPECT_EQ(out.labels[60], -1);
  EXPECT_LT(std::fabs(out.lines[0].line.rho - 3.0), 1e-6);
}

TEST(OptimalModule, CrossesMissingBeamsAsFarAsTheSensorLosesThem) {
  SensorModel s = sensor(181, 0.01);
  s.geometry = ScanGeometry(radians(-45), radians(0.5), 181);
  std::vector<double> ranges;
  for (int i = 0; i < 181; ++i) ranges.push_back(3.0 / s.geometry.direction(i).x());
  for (std::size_t i = 80; i < 83; ++i) ranges[i] = kInfinity;
  const auto module = Registry<LineExtractor>::make("optimal");
  EXPECT_EQ(module->extract({s, ranges}, silent).lines.size(), 2u);  // an opening
  s.noise.dropout_probability = 0.2;
  EXPECT_EQ(module->extract({s, ranges}, silent).lines.size(), 1u);  // lost returns
}

TEST(OptimalModule, GivesAtMostAsManyLinesAsRequested) {
  const SensorModel s = sensor(451, 0.02);
  const std::vector<double> ranges = room_scan(s, 3);
  for (const std::int64_t k : {1, 3, 6}) {
    const auto module = Registry<LineExtractor>::make("optimal", {{"max_lines", k}});
    const std::size_t lines = module->extract({s, ranges}, silent).lines.size();
    EXPECT_LE(lines, static_cast<std::size_t>(k));
    EXPECT_GE(lines, 1u);
  }
}

TEST(OptimalModule, AnswersDegenerateScans) {
  const auto module = Registry<LineExtractor>::make("optimal", {{"min_points", std::int64_t{2}}});
  for (const int beams : {0, 1, 2, 3, 10})
    for (const double value : {std::nan(""), kInfinity, -kInfinity, 0.0, 2.0, 1e-6}) {
      const SensorModel s = sensor(beams, 0.01);
      const std::vector<double> ranges(static_cast<std::size_t>(beams), value);
      const ScanLines out = module->extract({s, ranges}, silent);
      EXPECT_EQ(out.labels.size(), ranges.size());
      for (const LineFeature& line : out.lines) EXPECT_TRUE(line.segment.a.allFinite() && line.segment.b.allFinite());
    }
  const SensorModel no_noise = sensor(100, 0.0);
  const std::vector<double> ranges = room_scan(no_noise, 1);
  EXPECT_FALSE(module->extract({no_noise, ranges}, silent).lines.empty());
}

TEST(OptimalModule, AnswersAHundredThousandBeams) {
  const auto module = Registry<LineExtractor>::make("optimal");
  const SensorModel s = sensor(100000, 0.02);
  std::vector<double> one_wall, circle;
  for (int i = 0; i < 100000; ++i) {
    CounterRng rng(1, RngStream::range, 0, static_cast<std::uint32_t>(i));
    one_wall.push_back(2.0 / std::max(s.geometry.direction(i).x(), 0.2) + 0.02 * rng.normal());
    circle.push_back(3.0 + 0.02 * rng.normal());
  }
  const ScanLines walls = module->extract({s, one_wall}, silent);
  ASSERT_FALSE(walls.lines.empty());
  bool found = false;
  for (const LineFeature& line : walls.lines) {
    const auto d = line_difference(line.line, {2.0, 0.0});
    found = found || (d.rho < 0.001 && d.alpha < 0.001 && line.points > 55000);
  }
  EXPECT_TRUE(found);
  EXPECT_GT(module->extract({s, circle}, silent).lines.size(), 10u);
}

}  // namespace
}  // namespace scanbench::extract
