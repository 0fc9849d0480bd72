// Lines whose ends are uncertain: what follows from Bayes' rule when the readings are drawn as the model says.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "algorithms/extract/line_ends.hpp"
#include "core/rng.hpp"

namespace scanbench::extract {
namespace {

constexpr double kSigma = 0.02;
constexpr int kReadings = 40;

BeamLine wall_at(double rho) {
  return {.theta = Vec2(1.0 / rho, 0.0), .information = Eigen::Matrix2d::Identity()};
}

// A wall x = 2 m whose last readings, j with probability proportional to 2^-j, lie anywhere between it and x = 2.15 m.
std::vector<BeamReading> wall_with_a_tail(std::uint32_t seed, bool tail) {
  CounterRng rng(seed, RngStream::range);
  int foreign = 0;
  if (tail) {
    double u = rng.uniform() * (2.0 - std::pow(0.5, 6));
    for (double share = 1.0; u > share; share *= 0.5, ++foreign) u -= share;
  }
  std::vector<BeamReading> readings;
  for (int i = 0; i < kReadings; ++i) {
    const double phi = -0.3 + 0.02 * i;
    const double x = i >= kReadings - foreign ? 2.0 + 0.15 * rng.uniform() : 2.0;
    readings.push_back({{std::cos(phi), std::sin(phi)}, x / std::cos(phi) + kSigma * rng.normal()});
  }
  return readings;
}

SensorNoise noise() {
  SensorNoise n;
  n.sigma_m = kSigma;
  return n;
}

double squared_error(const BeamLine& line) {
  const Vec2 e = line.theta - Vec2(0.5, 0.0);
  return e.dot(line.information * e);
}

TEST(LineEnds, NothingBeyondChangesNothing) {
  const auto readings = wall_with_a_tail(1, false);
  const auto line = fit_beam_line(readings, noise());
  ASSERT_TRUE(line);
  const UncertainLine same = with_uncertain_ends(*line, readings, noise(), {}, 3);
  EXPECT_EQ(same.line.theta, line->theta);
  EXPECT_EQ(same.line.information, line->information);
  EXPECT_EQ(same.foreign, (std::array{0, 0}));
}

TEST(LineEnds, ErrorsAreAsLargeAsTheWholeCovarianceSays) {
  // E[e e' | readings] = C when the truth is drawn from what C is averaged over, so e' C^-1 e has the mean 2.
  const int trials = 4000;
  double averaged = 0.0, plain = 0.0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const auto readings = wall_with_a_tail(seed, true);
    const auto line = fit_beam_line(readings, noise());
    ASSERT_TRUE(line);
    const UncertainLine u =
        with_uncertain_ends(*line, readings, noise(), {std::nullopt, Beyond{wall_at(2.15), 0.0}}, 3);
    averaged += squared_error(u.line) / trials;
    plain += squared_error(*line) / trials;
  }
  EXPECT_NEAR(averaged, 2.0, 4 * 2.0 / std::sqrt(trials));
  EXPECT_GT(plain, 2.5);  // the same readings taken for the wall's
}

TEST(LineEnds, FarReadingsAreForeignAndFewRemain) {
  auto readings = wall_with_a_tail(3, false);
  for (std::size_t i = kReadings - 3; i < kReadings; ++i) readings[i].range_m += 0.12;
  const auto line = fit_beam_line(readings, noise());
  ASSERT_TRUE(line);
  const std::array<std::optional<Beyond>, 2> beyond = {std::nullopt, Beyond{wall_at(2.3), 0.0}};
  EXPECT_EQ(with_uncertain_ends(*line, readings, noise(), beyond, 3).foreign[1], 3);
  EXPECT_EQ(with_uncertain_ends(*line, readings, noise(), beyond, kReadings).foreign[1], 0);
}

}  // namespace
}  // namespace scanbench::extract
