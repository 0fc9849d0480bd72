// Lines that may cover two walls: what follows from Bayes' rule when the readings are drawn as the model says, and the
// sums against refits.
#include "algorithms/extract/optimal/hidden_break.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/index.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

constexpr double kSigma = 0.01;
constexpr int kReadings = 60;
constexpr int kLeast = 4;

SensorNoise noise() {
  SensorNoise n;
  n.sigma_m = kSigma;
  return n;
}

Vec2 direction(int i) {
  const double phi = -0.6 + 0.02 * i;
  return {std::cos(phi), std::sin(phi)};
}

// Readings on theta_first before `cut` and on theta_last behind it.
std::vector<BeamReading> readings_of(const Vec2& theta_first, const Vec2& theta_last, int cut, CounterRng& rng) {
  std::vector<BeamReading> readings;
  for (int i = 0; i < kReadings; ++i) {
    const Vec2& theta = i < cut ? theta_first : theta_last;
    readings.push_back({direction(i), 1.0 / theta.dot(direction(i)) + kSigma * rng.normal()});
  }
  return readings;
}

// Fisher information of a part of the line.
Eigen::Matrix2d information(const Vec2& theta, int first, int last) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = first; i < last; ++i) {
    const double r = 1.0 / theta.dot(direction(i));
    const Vec2 g = r * r / kSigma * direction(i);
    sum += g * g.transpose();
  }
  return sum;
}

double squared_error(const BeamLine& line, const Vec2& truth) {
  const Vec2 e = line.theta - truth;
  return e.dot(line.information * e);
}

TEST(HiddenBreak, ErrorsAreAsLargeAsTheWholeCovarianceSays) {
  // Every other line is two walls. Their difference is drawn from the prior of the model: as uncertain as one reading
  // on each part leaves it.
  const int trials = 4000;
  const Vec2 theta(0.5, 0.0);
  double averaged = 0.0, plain = 0.0, probability = 0.0, broken = 0.0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    CounterRng rng(seed, RngStream::range);
    Vec2 other = theta, truth = theta;
    int cut = kReadings;
    if (rng.uniform() < 0.5) {
      cut = kLeast + static_cast<int>((kReadings - 2 * kLeast + 1) * rng.uniform());
      const double width = static_cast<double>(cut) * (kReadings - cut) / kReadings;
      const Eigen::Matrix2d spread =
          width * (information(theta, 0, cut).inverse() + information(theta, cut, kReadings).inverse());
      const Vec2 draw(rng.normal(), rng.normal());
      other = theta + spread.llt().matrixL() * draw;
      const auto end = [&](const Vec2& t, int i) { return Vec2(direction(i) / t.dot(direction(i))); };
      const double first = (end(theta, cut - 1) - end(theta, 0)).norm();
      const double last = (end(other, kReadings - 1) - end(other, cut)).norm();
      truth = first >= last ? theta : other;
      broken += 1.0 / trials;
    }
    const auto readings = readings_of(theta, other, cut, rng);
    const auto line = fit_beam_line(readings, noise());
    ASSERT_TRUE(line);
    const HiddenBreak hidden(*line, readings, noise(), kLeast);
    ASSERT_TRUE(hidden.possible());
    averaged += squared_error(hidden.average(*line, 0.5), truth) / trials;
    plain += squared_error(*line, truth) / trials;
    probability += hidden.probability(0.5) / trials;
  }
  EXPECT_NEAR(averaged, 2.0, 0.2);  // four standard errors of a mean of 4000 are 0.13; the model is linear
  EXPECT_GT(plain, 4.0);            // the same lines if they count as one wall
  EXPECT_NEAR(probability, broken, 0.03);
}

TEST(HiddenBreak, TheDensityIsThatOfSeparateFits) {
  CounterRng rng(5, RngStream::range);
  const auto readings = readings_of({0.5, 0.0}, {0.497, 0.004}, 22, rng);
  const auto line = fit_beam_line(readings, noise());
  ASSERT_TRUE(line);
  const auto half_squares = [&](std::span<const BeamReading> part) {
    const auto fit = fit_beam_line(part, noise());
    double sum = 0.0;
    for (const BeamReading& b : part) sum += 0.5 * std::pow((b.range_m - fit->range(b.direction)) / kSigma, 2);
    return sum;
  };
  // The prior of the difference is n_1 n_2 / n times the covariance of its estimate (a g-prior): the exponent shrinks
  // by w / (1 + w), and the factor 1 / (1 + w) is that of two dimensions.
  double expected = 0.0;
  for (int cut = kLeast; cut <= kReadings - kLeast; ++cut) {
    const std::span all(readings);
    const double gain =
        half_squares(all) - half_squares(all.first(as_index(cut))) - half_squares(all.subspan(as_index(cut)));
    const double w = static_cast<double>(cut) * (kReadings - cut) / kReadings;
    expected += std::exp(gain * w / (1 + w)) / (1 + w) / (kReadings - 2 * kLeast + 1);
  }
  const HiddenBreak hidden(*line, readings, noise(), kLeast);
  EXPECT_NEAR(hidden.bayes_factor() / expected, 1.0, 0.1);  // linear about the line of all readings
  EXPECT_NEAR(hidden.probability(0.2), 0.2 * expected / (0.8 + 0.2 * expected), 0.05);
}

TEST(HiddenBreak, FewReadingsLeaveTheLineAsItIs) {
  CounterRng rng(6, RngStream::range);
  const auto readings = readings_of({0.5, 0.0}, {0.5, 0.0}, 0, rng);
  const auto few = std::span(readings).first(2 * kLeast - 1);
  const auto line = fit_beam_line(few, noise());
  ASSERT_TRUE(line);
  const HiddenBreak hidden(*line, few, noise(), kLeast);
  EXPECT_FALSE(hidden.possible());
  EXPECT_EQ(hidden.average(*line, 0.5).theta, line->theta);
  EXPECT_EQ(hidden.average(*line, 0.5).information, line->information);
}

TEST(HiddenBreak, ItsDoubtNeverShrinksTheCovariance) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    CounterRng rng(seed, RngStream::range);
    const auto readings = readings_of({0.5, 0.0}, {0.5, 0.002 * (seed % 5)}, 30, rng);
    const auto line = fit_beam_line(readings, noise());
    ASSERT_TRUE(line);
    const BeamLine averaged = HiddenBreak(*line, readings, noise(), kLeast).average(*line, 0.3);
    const Eigen::Matrix2d growth = averaged.information.inverse() - line->information.inverse();
    EXPECT_GE(growth.determinant(), -1e-18);
    EXPECT_GE(growth.trace(), 0.0);
  }
}

TEST(HiddenBreak, AFitThatDidNotConvergeStaysFinite) {
  // A sensor whose noise jumps at a range leaves the fit of a line across that range swinging: its information is then
  // not that of the readings, and it is not their best line.
  CounterRng rng(7, RngStream::range);
  const auto readings = readings_of({0.5, 0.0}, {0.5, 0.0}, 0, rng);
  const auto line = fit_beam_line(readings, noise());
  ASSERT_TRUE(line);
  BeamLine swinging = *line;
  swinging.theta *= 1.2;
  swinging.information *= 0.05;
  const BeamLine averaged = HiddenBreak(swinging, readings, noise(), kLeast).average(swinging, 0.3);
  EXPECT_TRUE(averaged.theta.allFinite());
  EXPECT_TRUE(averaged.information.allFinite());
}

}  // namespace
}  // namespace scanbench::extract
