// Fuzzy clustering of lines, Borges & Aldon 2000, section 2.3: the properties that equations (1) to (10) imply.
#include "algorithms/extract/parts/fuzzy_clustering.hpp"

#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "algorithms/extract/parts/fuzzy_kernels.hpp"
#include "core/error.hpp"
#include "core/geometry/least_squares.hpp"
#include "core/geometry/pose2.hpp"
#include "core/isa.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

struct Scene {
  std::vector<Vec2> points;
  std::vector<FuzzyLine> initial;
};

// Two random segments with noise, in order, and the halves as prototypes.
Scene two_segments(std::uint32_t seed, double noise_m = 0.02, int per_segment = 20) {
  CounterRng rng(seed, RngStream::pose);
  Scene scene;
  for (int s = 0; s < 2; ++s) {
    const Vec2 a(6 * rng.uniform() - 3, 6 * rng.uniform() - 3);
    const double angle = kTwoPi * rng.uniform();
    const Vec2 d = (0.5 + 2 * rng.uniform()) * Vec2(std::cos(angle), std::sin(angle));
    for (int i = 0; i < per_segment; ++i)
      scene.points.push_back(a + (i / (per_segment - 1.0)) * d + noise_m * Vec2(rng.normal(), rng.normal()));
  }
  const std::span<const Vec2> all(scene.points);
  const std::size_t half = all.size() / 2;
  scene.initial = {prototype_of(all.first(half - 3), {1, 0}), prototype_of(all.subspan(half - 3), {1, 0})};
  return scene;
}

double cost(const std::vector<Vec2>& points, const FuzzyLines& r, double m) {  // eqs (1), (4), (10), as printed
  double sum = 0;
  for (std::size_t i = 0; i < r.lines.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double f = r.lines[i].rho - r.lines[i].normal.dot(points[j]);
      sum += std::pow(r.membership(i, j), m) * (f * f + (points[j] - r.lines[i].centre).squaredNorm());
    }
  return sum;
}

double line_distance(const FuzzyLine& a, const FuzzyLine& b) {
  const double sign = a.normal.dot(b.normal) < 0 ? -1 : 1;
  return (a.normal - sign * b.normal).norm() + std::fabs(a.rho - sign * b.rho) + (a.centre - b.centre).norm();
}

TEST(FuzzyLines, NeverIncreaseTheCost) {
  for (const double m : {1.3, 2.0, 3.0})
    for (const bool penalty : {true, false})
      for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Scene scene = two_segments(seed);
        const FuzzyLines r = fuzzy_lines(scene.points, scene.initial, {.fuzzifier = m, .penalty = penalty});
        ASSERT_EQ(r.costs.size(), 2 * static_cast<std::size_t>(r.iterations));
        for (std::size_t k = 1; k < r.costs.size(); ++k) ASSERT_LE(r.costs[k], r.costs[k - 1] * (1 + 1e-12));
      }
}

// Two lines with the fuzzifier 2 are clustered by kernels in lanes, everything else by the formulas one point at a
// time. The next number after 2 changes the exact result by less than rounding does.
TEST(FuzzyLines, AreTheSameInLanesUpToRounding) {
  const double other = std::nextafter(2.0, 3.0);
  for (const bool penalty : {true, false})
    for (const int count : {1, 2, 7, 40})
      for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Scene scene = two_segments(seed, 0.02, count + 3);
        // Few iterations: where two clusterings compete, rounding may decide between them in the end.
        const FuzzyLines a = fuzzy_lines(scene.points, scene.initial, {.penalty = penalty, .max_iterations = 3});
        const FuzzyLines b =
            fuzzy_lines(scene.points, scene.initial, {.fuzzifier = other, .penalty = penalty, .max_iterations = 3});
        ASSERT_EQ(a.iterations, b.iterations);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(line_distance(a.lines[i], b.lines[i]), 1e-9) << seed;
        for (std::size_t k = 0; k < a.memberships.size(); ++k) EXPECT_NEAR(a.memberships[k], b.memberships[k], 1e-9);
        for (std::size_t k = 0; k < a.costs.size(); ++k) EXPECT_NEAR(a.costs[k], b.costs[k], 1e-12 + 1e-9 * b.costs[k]);
      }
}

TEST(FuzzyKernels, HaveTheSameBytesOnEveryProcessor) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has one set of kernels";
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Scene scene = two_segments(seed, 0.02, 3 + static_cast<int>(seed % 5));
    const std::size_t n = scene.points.size();
    std::vector<double> x(n + kFuzzyLanes), y(n + kFuzzyLanes);
    for (std::size_t j = 0; j < n; ++j) {
      x[j] = scene.points[j].x();
      y[j] = scene.points[j].y();
    }
    const PointArrays points{x.data(), y.data(), static_cast<int>(n)};
    TwoLines lines{};
    lines.penalty = seed % 2 == 0;
    for (std::size_t i = 0; i < 2; ++i) {
      lines.normal_x[i] = scene.initial[i].normal.x();
      lines.normal_y[i] = scene.initial[i].normal.y();
      lines.rho[i] = scene.initial[i].rho;
      lines.centre_x[i] = scene.initial[i].centre.x();
      lines.centre_y[i] = scene.initial[i].centre.y();
    }
    std::vector<std::vector<double>> u(4, std::vector<double>(n + kFuzzyLanes));
    double* const first[] = {u[0].data(), u[1].data()};
    double* const second[] = {u[2].data(), u[3].data()};
    const TwoMeans a = baseline::kFuzzyKernels.memberships(points, lines, first);
    const TwoMeans b = v3::kFuzzyKernels.memberships(points, lines, second);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    EXPECT_EQ(u[0], u[2]);
    EXPECT_EQ(u[1], u[3]);
    const TwoMoments c = baseline::kFuzzyKernels.moments(points, first, lines.centre_x, lines.centre_y);
    const TwoMoments d = v3::kFuzzyKernels.moments(points, second, lines.centre_x, lines.centre_y);
    EXPECT_EQ(std::memcmp(&c, &d, sizeof c), 0);
  }
}

TEST(FuzzyLines, ReportTheCostOfTheirResult) {
  const Scene scene = two_segments(7);
  for (const double m : {1.5, 2.0}) {
    const FuzzyLines r = fuzzy_lines(scene.points, scene.initial, {.fuzzifier = m});
    EXPECT_NEAR(r.costs.back(), cost(scene.points, r, m), 1e-9 * r.costs.back());
  }
}

TEST(FuzzyLines, HaveMembershipsBetweenZeroAndOneThatSumToOne) {
  for (const double m : {1.01, 2.0, 5.0}) {
    const Scene scene = two_segments(3);
    std::vector<FuzzyLine> three = scene.initial;
    three.push_back({{0, 1}, 0.3, {0.1, 0.3}});
    const FuzzyLines r = fuzzy_lines(scene.points, three, {.fuzzifier = m});
    for (std::size_t j = 0; j < scene.points.size(); ++j) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(r.membership(i, j), 0.0);
        EXPECT_LE(r.membership(i, j), 1.0);
        sum += r.membership(i, j);
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
    }
  }
}

TEST(FuzzyLines, GiveAPointOnACentreToThatPrototypeOnly) {
  // One iteration: the memberships are those of the initial prototypes.
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {5, 5}, {2, 1}};
  const std::vector<FuzzyLine> initial = {{{0, 1}, 0.0, {0, 0}}, {{0, 1}, 5.0, {5, 5}}};
  const FuzzyLines r = fuzzy_lines(points, initial, {.max_iterations = 1});
  EXPECT_EQ(r.membership(0, 0), 1.0);
  EXPECT_EQ(r.membership(1, 0), 0.0);
  EXPECT_EQ(r.membership(0, 2), 0.0);
  EXPECT_EQ(r.membership(1, 2), 1.0);
  for (const double u : r.memberships) EXPECT_TRUE(std::isfinite(u));
  // Eq. (6) by hand for point (2, 1): d^2 = 1 + 5 and 16 + 25.
  EXPECT_NEAR(r.membership(0, 3), 1.0 / (1.0 + 6.0 / 41.0), 1e-15);
}

TEST(FuzzyLines, ShareAPointOnTwoCentresEqually) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {-1, 0}, {0, 2}};
  const std::vector<FuzzyLine> initial = {{{0, 1}, 0.0, {0, 0}}, {{1, 0}, 0.0, {0, 0}}};
  const FuzzyLines r = fuzzy_lines(points, initial, {.max_iterations = 1});
  EXPECT_EQ(r.membership(0, 0), 0.5);
  EXPECT_EQ(r.membership(1, 0), 0.5);
}

TEST(FuzzyLines, StayFiniteWhenAllPointsCoincide) {
  const std::vector<Vec2> points(10, Vec2(1, 2));
  const std::vector<FuzzyLine> initial = {{{0.6, 0.8}, 2.2, {1, 2}}, {{0, 1}, 2.0, {1, 2}}};
  const FuzzyLines r = fuzzy_lines(points, initial);
  for (const FuzzyLine& line : r.lines) {
    EXPECT_TRUE(line.normal.allFinite() && line.centre.allFinite() && std::isfinite(line.rho));
  }
  EXPECT_EQ(r.lines[0].normal, initial[0].normal);  // the points have no direction, so the angle stays
}

TEST(FuzzyLines, WithOnePrototypeAreTheOrthogonalLeastSquaresLine) {
  const Scene scene = two_segments(11);
  for (const bool penalty : {true, false}) {
    const FuzzyLines r = fuzzy_lines(scene.points, std::vector<FuzzyLine>{{{0, 1}, 3.0, {1, 3}}}, {.penalty = penalty});
    const LineFit fit = fit_line(scene.points);
    EXPECT_NEAR(std::fabs(r.lines[0].normal.dot(fit.normal)), 1.0, 1e-12);
    EXPECT_NEAR(std::fabs(r.lines[0].rho), std::fabs(fit.offset), 1e-12);
    for (const double u : r.memberships) EXPECT_EQ(u, 1.0);
  }
}

TEST(FuzzyLines, FindTheSteepLineThatThePlainArctangentTurnsBy90Degrees) {
  const double a = radians(70);  // normal more than 45 degrees from the x axis
  std::vector<Vec2> points;
  for (int i = 0; i < 10; ++i)
    points.push_back(2.0 * Vec2(std::cos(a), std::sin(a)) + 0.1 * i * Vec2(-std::sin(a), std::cos(a)));
  const FuzzyLines r = fuzzy_lines(points, std::vector<FuzzyLine>{{{1, 0}, 0.0, {0, 0}}});
  EXPECT_LT(
      line_difference(canonical(r.lines[0].rho, std::atan2(r.lines[0].normal.y(), r.lines[0].normal.x())), {2.0, a})
          .alpha,
      1e-12);
}

TEST(FuzzyLines, DoNotDependOnTheOrderOfThePoints) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Scene scene = two_segments(seed);
    std::vector<Vec2> shuffled = scene.points;
    CounterRng rng(seed, RngStream::resampling);
    for (std::size_t k = shuffled.size() - 1; k > 0; --k) std::swap(shuffled[k], shuffled[rng.bits() % (k + 1)]);
    const FuzzyLines a = fuzzy_lines(scene.points, scene.initial);
    const FuzzyLines b = fuzzy_lines(shuffled, scene.initial);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(line_distance(a.lines[i], b.lines[i]), 1e-9);
  }
}

TEST(FuzzyLines, ArePermutedWithTheirInitialPrototypes) {
  const Scene scene = two_segments(5);
  const FuzzyLines a = fuzzy_lines(scene.points, scene.initial);
  const FuzzyLines b = fuzzy_lines(scene.points, std::vector<FuzzyLine>{scene.initial[1], scene.initial[0]});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(line_distance(a.lines[i], b.lines[1 - i]), 1e-12);
    for (std::size_t j = 0; j < scene.points.size(); ++j)
      EXPECT_NEAR(a.membership(i, j), b.membership(1 - i, j), 1e-12);
  }
}

TEST(FuzzyLines, MoveWithThePoints) {
  const Scene scene = two_segments(9);
  const Pose2 motion(3.0, -7.0, 2.2);
  std::vector<Vec2> moved;
  for (const Vec2& p : scene.points) moved.push_back(motion * p);
  std::vector<FuzzyLine> initial;
  for (const FuzzyLine& line : scene.initial) {
    const Vec2 n = motion.rotate(line.normal);
    initial.push_back({n, n.dot(motion * line.centre), motion * line.centre});
  }
  const FuzzyLines a = fuzzy_lines(scene.points, scene.initial);
  const FuzzyLines b = fuzzy_lines(moved, initial);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::fabs(motion.rotate(a.lines[i].normal).dot(b.lines[i].normal)), 1.0, 1e-9);
    EXPECT_LT((motion * a.lines[i].centre - b.lines[i].centre).norm(), 1e-9);
  }
}

TEST(FuzzyLines, RefuseAFuzzifierThatIsNotAboveOne) {
  const Scene scene = two_segments(1);
  EXPECT_THROW(fuzzy_lines(scene.points, scene.initial, {.fuzzifier = 1.0}), ParamError);
  EXPECT_THROW(fuzzy_lines(scene.points, scene.initial, {.fuzzifier = std::nan("")}), ParamError);
}

TEST(FuzzyLines, OfNoPointsAreTheInitialOnes) {
  const std::vector<FuzzyLine> initial = {{{0, 1}, 3.0, {1, 3}}};
  const FuzzyLines r = fuzzy_lines({}, initial);
  ASSERT_EQ(r.lines.size(), 1u);
  EXPECT_EQ(r.lines[0].rho, 3.0);
}

TEST(FuzzyLinesModule, FindsTheTwoWallsOfACornerAndNothingInAnEmptyScan) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-45), radians(1), 181);  // corner at (2, 2), walls x = 2 and y = 2
  std::vector<double> ranges;
  for (int i = 0; i < 181; ++i) {
    const Vec2 d = sensor.geometry.direction(i);
    ranges.push_back(2.0 / std::max(d.x(), d.y()));
  }
  Trace silent;
  const auto module = Registry<LineExtractor>::make("fuzzy_lines", {{"lines", std::int64_t{2}}});
  const ScanLines out = module->extract({sensor, ranges}, silent);
  ASSERT_EQ(out.lines.size(), 2u);
  EXPECT_LT(line_difference(out.lines[0].line, {2.0, 0.0}).alpha, radians(1));
  EXPECT_LT(line_difference(out.lines[1].line, {2.0, kPi / 2}).alpha, radians(1));
  const std::vector<double> none(181, std::nan(""));
  EXPECT_TRUE(module->extract({sensor, none}, silent).lines.empty());
  const auto more_lines_than_points = Registry<LineExtractor>::make("fuzzy_lines", {{"lines", std::int64_t{1000}}});
  EXPECT_NO_THROW(more_lines_than_points->extract({sensor, ranges}, silent));
}

}  // namespace
}  // namespace scanbench::extract
