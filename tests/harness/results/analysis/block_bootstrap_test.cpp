// Intervals of means over scans: their coverage where neighbours resemble each other, and what they are exactly.
#include "harness/results/analysis/block_bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

double as_is(double value) {
  return value;
}

/// Pairs whose differences are a stationary AR(1) process with this mean and a standard deviation of 1.
std::vector<ScanPair> correlated_pairs(std::uint64_t seed, std::size_t count, double correlation, double mean) {
  CounterRng noise(seed, RngStream::pose);
  std::vector<ScanPair> pairs;
  double state = noise.normal();
  for (std::size_t i = 0; i < count; ++i) {
    const double before = 10.0 + 3.0 * noise.normal();  // scans differ by more than the runs do
    pairs.push_back({before, 1.0, before + mean + state, 1.0});
    state = correlation * state + std::sqrt(1.0 - correlation * correlation) * noise.normal();
  }
  return pairs;
}

/// How many of 300 intervals contain the true mean difference.
struct Coverage {
  int of_blocks = 0;
  int of_independent_scans = 0;
};

Coverage coverage(std::size_t count, double correlation) {
  constexpr double kMean = 0.3;
  Coverage covered;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto pairs = correlated_pairs(seed, count, correlation, kMean);
    const MeanInterval blocks = block_interval(pairs, ScanMean::mean, as_is).difference;
    covered.of_blocks += blocks.low <= kMean && kMean <= blocks.high;
    std::vector<double> differences;
    for (const auto& pair : pairs) differences.push_back(pair.after - pair.before);
    const MeanInterval independent = mean_interval(differences);
    covered.of_independent_scans += independent.low <= kMean && kMean <= independent.high;
  }
  return covered;
}

TEST(BlockInterval, CoversTheTrueDifferenceOfCorrelatedScansWhereIndependentDrawsDoNot) {
  // The mean of an AR(1) process has (1 + a) / (1 - a) times the variance of independent values: intervals that ignore
  // it are half as wide as they should be for a = 0.6, and cover in 67 % of all cases.
  const Coverage of = coverage(400, 0.6);
  EXPECT_GE(of.of_blocks, 274);  // 95 % of 300 less three standard deviations (3.8)
  EXPECT_LE(of.of_independent_scans, 225);
}

TEST(BlockInterval, CoversTheTrueDifferenceOfIndependentScans) {
  const Coverage of = coverage(200, 0.0);
  EXPECT_GE(of.of_blocks, 274);
  EXPECT_LE(of.of_blocks, 299);  // it is not simply wide
}

TEST(BlockInterval, OfEqualPairsIsExactlyZero) {
  std::vector<ScanPair> pairs(50, {0.1, 1.0, 0.1, 1.0});
  pairs[7] = {kNaN, 0.0, kNaN, 0.0};
  const BlockInterval interval = block_interval(pairs, ScanMean::mean, as_is);
  EXPECT_EQ(interval.difference.mean, 0.0);
  EXPECT_EQ(interval.difference.low, 0.0);
  EXPECT_EQ(interval.difference.high, 0.0);
  EXPECT_EQ(interval.p, 1.0);
}

TEST(BlockInterval, OfAConstantShiftHasNoWidth) {
  std::vector<ScanPair> pairs;
  for (int i = 0; i < 40; ++i) pairs.push_back({1.0 * i, 1.0, 1.0 * i + 0.5, 1.0});
  const BlockInterval interval = block_interval(pairs, ScanMean::mean, as_is);
  EXPECT_NEAR(interval.difference.mean, 0.5, 1e-12);
  EXPECT_NEAR(interval.difference.low, 0.5, 1e-9);
  EXPECT_NEAR(interval.difference.high, 0.5, 1e-9);
  EXPECT_LT(interval.p, 1e-6);
}

TEST(BlockInterval, IsThatOfTheMetricsOwnMeans) {
  // Weights are counts: a share of 1 line of 2 and of 3 lines of 8 is 4 of 10. A scan may have a value in one run only.
  std::vector<ScanPair> pairs(20, {0.5, 2.0, 0.5, 2.0});
  pairs.insert(pairs.end(), 20, {0.375, 8.0, 0.25, 8.0});
  pairs.push_back({0.9, 3.0, kNaN, 0.0});
  const BlockInterval interval = block_interval(pairs, ScanMean::mean, as_is);
  const double before = (20 * 1.0 + 20 * 3.0 + 2.7) / (20 * 2.0 + 20 * 8.0 + 3.0);
  const double after = (20 * 1.0 + 20 * 2.0) / (20 * 2.0 + 20 * 8.0);
  EXPECT_NEAR(interval.difference.mean, after - before, 1e-12);
  EXPECT_LT(interval.difference.low, interval.difference.mean);
  EXPECT_EQ(interval.difference.count, 41);

  const BlockInterval rms = block_interval(pairs, ScanMean::root_mean_square, as_is);
  const double rms_before = std::sqrt((20 * 0.5 + 20 * 8 * 0.375 * 0.375 + 3 * 0.81) / 203.0);
  const double rms_after = std::sqrt((20 * 0.5 + 20 * 8 * 0.0625) / 200.0);
  EXPECT_NEAR(rms.difference.mean, rms_after - rms_before, 1e-12);
}

TEST(BlockInterval, IsDeterministicAndFollowsTheCost) {
  const auto pairs = correlated_pairs(5, 100, 0.5, 0.3);
  const BlockInterval one = block_interval(pairs, ScanMean::mean, as_is);
  const BlockInterval two = block_interval(pairs, ScanMean::mean, [](double value) { return -value; });
  EXPECT_EQ(one.difference.low, two.difference.low);
  EXPECT_EQ(one.difference.high, two.difference.high);
  EXPECT_EQ(two.worsening.mean, -one.difference.mean);
  EXPECT_EQ(one.p, two.p);
}

TEST(BlockInterval, WithHardlyAnyValuesIsUnbounded) {
  std::vector<ScanPair> pairs(300, {kNaN, 0.0, kNaN, 0.0});
  pairs[3] = {1.0, 1.0, kNaN, 0.0};
  pairs[200] = {kNaN, 0.0, 2.0, 1.0};  // a draw needs both
  const MeanInterval interval = block_interval(pairs, ScanMean::mean, as_is).difference;
  EXPECT_EQ(interval.mean, 1.0);
  EXPECT_TRUE(std::isinf(interval.low) || interval.low <= interval.mean);
}

TEST(BlockLength, GrowsWithTheCorrelationAndIsOneWithoutSpread) {
  const auto length = [](double correlation) {
    std::vector<double> lengths;
    for (std::uint64_t seed = 0; seed < 21; ++seed) {
      std::vector<double> series;
      for (const auto& pair : correlated_pairs(seed, 1000, correlation, 0.0))
        series.push_back(pair.after - pair.before);
      lengths.push_back(static_cast<double>(block_length(series)));
    }
    return median(lengths);
  };
  // Politis and White, equation 9: for AR(1) with correlation a, G / g(0) = 2 a / (1 - a^2) and the best length is
  // (3/2 (G / g(0))^2 n)^(1/3).
  const auto best = [](double a) { return std::cbrt(1.5 * std::pow(2 * a / (1 - a * a), 2) * 1000.0); };
  EXPECT_NEAR(length(0.5), best(0.5), 0.35 * best(0.5));
  EXPECT_NEAR(length(0.8), best(0.8), 0.35 * best(0.8));
  EXPECT_LE(length(0.0), 4.0);
  EXPECT_EQ(block_length(std::vector<double>(100, 0.7)), 1U);
}

}  // namespace
}  // namespace scanbench::results
