// How often the verdict on a night is wrong: simulated nights whose truth is known.
//
// The noise is that of real runs: of small changes of a threshold, the differences of F1 on equal seeds had standard
// deviations of 0.3 to 1.2 tolerances. Two programs whose seeds have nothing in common differ by three.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "made_up_runs.hpp"

namespace scanbench::results {
namespace {

constexpr int kNights = 200;
constexpr std::uint64_t kFirstNight = 9001;
constexpr double kTolerance = 0.005;  // of f1, the gate of pipelines that find lines
const std::vector<std::string> kPipelines{"a", "b", "c", "d", "e"};

/// What happened before a night, in tolerances of f1.
struct NightChange {
  double noise = 0.0;           ///< standard deviation of the difference on one seed
  double shift_of_a = 0.0;      ///< of pipeline a
  bool others_changed = false;  ///< by noise alone; else they are equal to the bit
  double outliers = 1.0;        ///< every tenth difference is this many times as large
};

double f1_before(std::uint64_t night, std::size_t pipeline, std::uint64_t seed) {
  CounterRng rng(night, RngStream::resampling, static_cast<std::uint32_t>(pipeline), static_cast<std::uint32_t>(seed));
  return 0.7 + 0.05 * static_cast<double>(pipeline) + 0.009 * rng.normal();
}

double f1_after(std::uint64_t night, std::size_t pipeline, std::uint64_t seed, const NightChange& change) {
  double f1 = f1_before(night, pipeline, seed);
  if (pipeline > 0 && !change.others_changed) return f1;
  CounterRng rng(night, RngStream::resampling, static_cast<std::uint32_t>(100 + pipeline),
                 static_cast<std::uint32_t>(seed));
  const double noise = change.noise * rng.normal();
  f1 += kTolerance * (rng.uniform() < 0.1 ? change.outliers : 1.0) * noise;
  return f1 + (pipeline == 0 ? kTolerance * change.shift_of_a : 0.0);
}

/// One night of the metric f1, which is the gate, and of `overlap`, which falls by a tenth in every night.
Comparison night_with(const NightChange& change, std::uint64_t night, std::size_t seeds) {
  const auto place = [](const std::string& pipeline) {
    return static_cast<std::size_t>(std::ranges::find(kPipelines, pipeline) - kPipelines.begin());
  };
  const auto before = [&](const std::string& pipeline, const std::string& metric, std::uint64_t seed) {
    return metric == "f1" ? f1_before(night, place(pipeline), seed) : 0.9;
  };
  const auto after = [&](const std::string& pipeline, const std::string& metric, std::uint64_t seed) {
    return metric == "f1" ? f1_after(night, place(pipeline), seed, change) : 0.8;
  };
  return compare(fixtures::made_up_run(kPipelines, {"f1", "overlap"}, seeds, before),
                 fixtures::made_up_run(kPipelines, {"f1", "overlap"}, seeds, after), Gates());
}

int nights_that_fail(const NightChange& change, std::size_t seeds) {
  int failed = 0;
  for (std::uint64_t k = 0; k < kNights; ++k)
    failed += verdict_word(night_with(change, kFirstNight + k, seeds)) == "FAIL" ? 1 : 0;
  return failed;
}

/// The nights in which the verdict names f1 of pipeline a as worse.
int nights_that_find_a(const NightChange& change, std::size_t seeds) {
  int found = 0;
  for (std::uint64_t k = 0; k < kNights; ++k) {
    const Comparison night = night_with(change, kFirstNight + k, seeds);
    const auto worse = changes_with(night, Finding::worse);
    found += std::ranges::any_of(worse, [](const MetricChange* c) { return c->pipeline == "a"; }) ? 1 : 0;
  }
  return found;
}

/// In tolerances.
double standard_errors(double count, double noise, std::size_t seeds) {
  return count * noise / std::sqrt(static_cast<double>(seeds));
}

TEST(SimulatedNights, WithoutAChangeRaiseAnAlarmInAtMostFivePercent) {
  EXPECT_EQ(nights_that_fail({.noise = 0.0, .others_changed = true}, 8), 0);
  for (const double noise : {1.0, 3.0})
    EXPECT_LE(nights_that_fail({.noise = noise, .others_changed = true}, 8), kNights / 20) << noise;
}

TEST(SimulatedNights, WithOutliersRaiseAnAlarmInAtMostFivePercent) {
  EXPECT_LE(nights_that_fail({.noise = 3.0, .others_changed = true, .outliers = 5.0}, 8), kNights / 20);
}

TEST(SimulatedNights, FindAGateThatFellByItsToleranceAndTwoStandardErrors) {
  for (const auto& [noise, seeds] : {std::pair(0.3, 8U), std::pair(0.7, 8U), std::pair(1.0, 20U)})
    EXPECT_GE(nights_that_find_a({noise, -1.0 - standard_errors(2.0, noise, seeds)}, seeds), kNights * 95 / 100)
        << noise << " tolerances, " << seeds << " seeds";
}

TEST(SimulatedNights, FindAGateThatFellByItsToleranceHalfOfTheTime) {
  // The mean of the seeds is above the tolerance with probability one half, so the count is binomial: four standard
  // deviations are 28.
  EXPECT_NEAR(nights_that_find_a({0.3, -1.0}, 8), kNights / 2, 28);
}

TEST(SimulatedNights, NeverFailForAnImprovementWhateverWatchedMetricsDo) {
  for (const double noise : {0.3, 1.0})
    for (const double tolerances : {0.5, 1.0, 3.0})
      EXPECT_EQ(nights_that_fail({noise, tolerances}, 8), 0) << tolerances;
}

}  // namespace
}  // namespace scanbench::results
