// Each part of the noise against its distribution, over a million readings; tolerances are five standard errors.
#include "sim/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/angles.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::sim {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kFrames = 1000;
constexpr std::uint32_t kBeams = 1000;
constexpr double kCount = 1e6;

SensorModel quiet_sensor() {
  SensorModel sensor;
  sensor.range_min_m = 0.1;
  sensor.range_max_m = 30.0;
  return sensor;
}

/// A million readings, the addresses of a thousand frames of a thousand beams.
std::vector<double> million(const std::function<double(const BeamAddress&)>& reading) {
  std::vector<double> values;
  values.reserve(kFrames * kBeams);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame)
    for (std::uint32_t beam = 0; beam < kBeams; ++beam) values.push_back(reading({11, frame, beam}));
  return values;
}

std::vector<double> readings(const SensorModel& sensor, double range, double cos_incidence = 1.0) {
  return million([&](const BeamAddress& a) { return observed_range(sensor, range, cos_incidence, a); });
}

/// Standard normal quantiles, from tables.
struct Quantile {
  double p;
  double z;
};
constexpr Quantile kQuantiles[] = {
    {0.001, -3.090232306167813}, {0.025, -1.959963984540054}, {0.25, -0.674489750196082}, {0.5, 0.0},
    {0.75, 0.674489750196082},   {0.975, 1.959963984540054},  {0.999, 3.090232306167813}};

double standard_normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(kTwoPi);
}

/// Mean, standard deviation and quantiles of a normal distribution, each within five standard errors.
void expect_normal(std::vector<double> values, double mean, double sigma) {
  const double n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double v : values) sum += v - mean;
  const double average = sum / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean - average) * (v - mean - average);
  EXPECT_NEAR(average, 0.0, 5.0 * sigma / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / (n - 1.0)), sigma, 5.0 * sigma / std::sqrt(2.0 * n));
  std::ranges::sort(values);
  for (const auto& [p, z] : kQuantiles) {
    const double error = sigma * std::sqrt(p * (1.0 - p) / n) / standard_normal_density(z);
    EXPECT_NEAR(values[static_cast<std::size_t>(p * n)], mean + z * sigma, 5.0 * error) << "quantile " << p;
  }
}

void expect_frequency(double count, double probability) {
  EXPECT_NEAR(count / kCount, probability, 5.0 * std::sqrt(probability * (1.0 - probability) / kCount));
}

double count_of(const std::vector<double>& values, double value) {
  return static_cast<double>(std::ranges::count(values, value));
}

TEST(Noise, ASensorWithoutNoiseReadsTheTruth) {
  const SensorModel sensor = quiet_sensor();
  EXPECT_EQ(observed_range(sensor, 12.3456789, 0.3, {1, 2, 3}), 12.3456789);
}

TEST(Noise, TheConstantGaussianPartHasItsMeanDeviationAndQuantiles) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.sigma_m = 0.05;
  expect_normal(readings(sensor, 7.0), 7.0, 0.05);
}

TEST(Noise, ConstantAndProportionalPartsAddInQuadrature) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.sigma_m = 0.03;
  sensor.noise.sigma_relative = 0.004;
  expect_normal(readings(sensor, 10.0), 10.0, 0.05);  // 3, 4, 5
}

TEST(Noise, TheProportionalPartReplacesTheConstantOneFromItsThresholdOn) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.sigma_m = 0.005;
  sensor.noise.sigma_relative = 0.005;
  sensor.noise.relative_from_m = 1.0;
  expect_normal(readings(sensor, 0.5), 0.5, 0.005);
  expect_normal(readings(sensor, 4.0), 4.0, 0.02);
}

TEST(Noise, BearingErrorsAreNormalAndZeroWithoutBearingNoise) {
  SensorNoise noise;
  EXPECT_EQ(bearing_error(noise, {1, 2, 3}), 0.0);
  noise.bearing_sigma_rad = 0.01;
  expect_normal(million([&](const BeamAddress& a) { return bearing_error(noise, a); }), 0.0, 0.01);
}

TEST(Noise, QuantisedReadingsAreTheNearestMultiples) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.quantum_m = 0.05;
  EXPECT_NEAR(observed_range(sensor, 2.024, 1.0, {}), 2.00, 1e-12);
  EXPECT_NEAR(observed_range(sensor, 2.026, 1.0, {}), 2.05, 1e-12);
  // With gaussian noise, P(k) is the normal probability of the interval that rounds to k.
  sensor.noise.sigma_m = 0.02;
  const auto values = readings(sensor, 2.0);
  const auto normal_cdf = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  for (int k = -2; k <= 2; ++k) {
    const double probability = normal_cdf((k + 0.5) * 2.5) - normal_cdf((k - 0.5) * 2.5);
    const double low = 2.0 + (k - 0.5) * 0.05;
    expect_frequency(
        static_cast<double>(std::ranges::count_if(values, [&](double v) { return v > low && v < low + 0.05; })),
        probability);
  }
  for (const double v : values) ASSERT_NEAR(v / 0.05, std::round(v / 0.05), 1e-9);
}

TEST(Noise, DropOutHasItsFrequencyAndGrowsWithIncidence) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.dropout_probability = 0.18;
  expect_frequency(count_of(readings(sensor, 5.0), kInf), 0.18);
  sensor.noise.dropout_grazing = 0.6;
  expect_frequency(count_of(readings(sensor, 5.0, 1.0), kInf), 0.18);
  expect_frequency(count_of(readings(sensor, 5.0, 0.5), kInf), 0.18 + 0.6 * 0.25);
  expect_frequency(count_of(readings(sensor, 5.0, 0.0), kInf), 0.78);
}

TEST(Noise, TheLossOfASurfaceIsAddedToTheDropOutOfTheSensor) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.dropout_probability = 0.18;
  const auto lost = [&](double loss) {
    return count_of(million([&](const BeamAddress& a) { return observed_range(sensor, 5.0, 1.0, a, loss); }), kInf);
  };
  expect_frequency(lost(0.5), 0.68);
  EXPECT_EQ(lost(1.0), kCount);
  sensor.noise.dropout_probability = 0.0;
  expect_frequency(lost(0.3), 0.3);
}

TEST(Noise, LossesOfAWholeScanAreThoseOfItsReadings) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.sigma_m = 0.02;
  const std::vector<double> ranges(kBeams, 5.0), losses{[] {
    std::vector<double> values(kBeams);
    for (std::size_t i = 0; i < kBeams; ++i) values[i] = static_cast<double>(i % 3) / 2.0;
    return values;
  }()};
  std::vector<double> values(kBeams);
  ScanNoise(sensor, 7).observe(2, ranges, {}, values, losses);
  for (std::uint32_t i = 0; i < kBeams; ++i)
    EXPECT_EQ(values[i], observed_range(sensor, 5.0, 0.0, {7, 2, i}, losses[i])) << i;
}

TEST(Noise, ShortReturnsHaveTheirFrequencyAndAreUniformUpToTheTruth) {
  SensorModel sensor = quiet_sensor();
  sensor.noise.spurious_probability = 0.1;
  std::vector<double> shorter;
  for (const double v : readings(sensor, 8.1))
    if (v != 8.1) shorter.push_back(v);
  expect_frequency(static_cast<double>(shorter.size()), 0.1);
  std::ranges::sort(shorter);
  const double n = static_cast<double>(shorter.size());
  EXPECT_GE(shorter.front(), 0.1);
  EXPECT_LE(shorter.back(), 8.1);
  for (const double p : {0.01, 0.1, 0.5, 0.9, 0.99})
    EXPECT_NEAR(shorter[static_cast<std::size_t>(p * n)], 0.1 + 8.0 * p, 5.0 * 8.0 * std::sqrt(p * (1.0 - p) / n));
}

TEST(Noise, MixedPixelsAreUniformBetweenTheTwoSurfaces) {
  auto values = million([](const BeamAddress& a) { return mixed_range(3.0, 7.0, a); });
  std::ranges::sort(values);
  EXPECT_GT(values.front(), 3.0);
  EXPECT_LT(values.back(), 7.0);
  for (const double p : {0.01, 0.1, 0.5, 0.9, 0.99})
    EXPECT_NEAR(values[static_cast<std::size_t>(p * kCount)], 3.0 + 4.0 * p,
                5.0 * 4.0 * std::sqrt(p * (1 - p) / kCount));
}

TEST(Noise, ABeamThatReturnsNothingStaysInfiniteUnderAllNoise) {
  SensorModel sensor = quiet_sensor();
  sensor.noise = {.sigma_m = 5.0,
                  .sigma_relative = 0.5,
                  .quantum_m = 0.05,
                  .dropout_probability = 0.1,
                  .dropout_grazing = 0.1,
                  .spurious_probability = 0.9};
  for (const double nothing : {kInf, 30.000001}) EXPECT_EQ(count_of(readings(sensor, nothing, 0.5), kInf), kCount);
}

TEST(Noise, ReadingsOutsideTheLimitsFollowRep117) {
  SensorModel sensor = quiet_sensor();
  EXPECT_EQ(observed_range(sensor, 0.0999, 1.0, {}), -kInf);
  EXPECT_EQ(observed_range(sensor, 0.1, 1.0, {}), 0.1);
  EXPECT_EQ(observed_range(sensor, 30.0, 1.0, {}), 30.0);
  sensor.noise.sigma_m = 0.05;
  // Half of the readings of a surface at range_min are too close, half of those at range_max too far.
  const auto near = readings(sensor, 0.1);
  expect_frequency(count_of(near, -kInf), 0.5);
  EXPECT_EQ(count_of(near, kInf), 0.0);
  const auto far = readings(sensor, 30.0);
  expect_frequency(count_of(far, kInf), 0.5);
  EXPECT_EQ(count_of(far, -kInf), 0.0);
  // With range_min 0, negative and zero readings are too close.
  sensor.range_min_m = 0.0;
  expect_frequency(count_of(readings(sensor, 0.05), -kInf), 0.158655253931457);  // normal probability below -1
  EXPECT_EQ(observed_range(quiet_sensor(), 0.0, 1.0, {}), -kInf);
}

TEST(Noise, EnablingOnePartDoesNotChangeTheOthers) {
  SensorModel gaussian = quiet_sensor();
  gaussian.noise.sigma_m = 0.05;
  SensorModel dropping = gaussian;
  dropping.noise.dropout_probability = 0.3;
  int kept = 0;
  for (std::uint32_t beam = 0; beam < 1000; ++beam) {
    const double both = observed_range(dropping, 5.0, 1.0, {3, 4, beam});
    if (both == kInf) continue;
    ++kept;
    ASSERT_EQ(both, observed_range(gaussian, 5.0, 1.0, {3, 4, beam}));
  }
  EXPECT_GT(kept, 600);
  EXPECT_LT(kept, 800);
}

}  // namespace
}  // namespace scanbench::sim
