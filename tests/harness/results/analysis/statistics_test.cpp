// Intervals by textbook numbers and by their coverage.
#include "harness/results/analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "core/distributions.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

TEST(MeanInterval, IsAtLeastStudentsForANormalSample) {
  // t(0.975, 4) = 2.7764; mean 3, standard deviation sqrt(2.5), n = 5: half width 1.9633.
  const std::array values = {1.0, 2.0, 3.0, 4.0, 5.0};
  const MeanInterval interval = mean_interval(values);
  EXPECT_DOUBLE_EQ(interval.mean, 3.0);
  EXPECT_LE(interval.low, 3.0 - 1.9632);
  EXPECT_GE(interval.high, 3.0 + 1.9632);
  EXPECT_NEAR(interval.half_width(), 1.9633, 1e-3);
}

TEST(MeanInterval, CoversTheTrueMeanOfNormalAndSkewedSamples) {
  // With n = 10 a percentile bootstrap covers 90 % (normal) and 80 % (lognormal); the wider of both intervals must do
  // better.
  int normal = 0;
  int lognormal = 0;
  constexpr int kTrials = 250;
  for (int trial = 0; trial < kTrials; ++trial) {
    CounterRng rng(5, RngStream::pose, static_cast<std::uint32_t>(trial));
    std::vector<double> a, b;
    for (int i = 0; i < 10; ++i) {
      a.push_back(rng.normal());
      b.push_back(portable::exp(rng.normal()));
    }
    const MeanInterval ia = mean_interval(a);
    const MeanInterval ib = mean_interval(b);
    normal += ia.low <= 0 && 0 <= ia.high;
    const double mean = std::exp(0.5);
    lognormal += ib.low <= mean && mean <= ib.high;
  }
  EXPECT_GT(normal, 0.93 * kTrials);
  EXPECT_GT(lognormal, 0.83 * kTrials);
}

TEST(MeanInterval, OfOneValueIsThatValueAndOfNoneIsNotANumber) {
  EXPECT_EQ(mean_interval(std::array{2.0}).low, 2.0);
  EXPECT_EQ(mean_interval(std::array{2.0, std::nan("")}).count, 1);
  EXPECT_TRUE(std::isnan(mean_interval(std::vector<double>{}).mean));
}

TEST(MeanInterval, OfEqualValuesHasNoWidth) {
  EXPECT_EQ(mean_interval(std::array{2.0, 2.0, 2.0}).half_width(), 0.0);
}

TEST(Median, IsTheMiddleOfWhatIsANumber) {
  EXPECT_EQ(median(std::array{3.0, 1.0, std::nan(""), 2.0}), 2.0);
  EXPECT_EQ(median(std::array{4.0, 1.0}), 2.5);
}

TEST(MedianInterval, IsBetweenTheRanksOfTheBinomialDistribution) {
  // P(6th < median < 15th of 20) = 1 - 2 P(X <= 5) = 0.959; of 6 values only the outermost reach 0.969; of 10 the 2nd
  // and the 9th 0.979 (Conover, Practical Nonparametric Statistics, table A3).
  std::vector<double> values;
  for (int i = 20; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(median_interval(values).low, 6.0);
  EXPECT_EQ(median_interval(values).high, 15.0);
  values.resize(10);  // 20 .. 11
  EXPECT_EQ(median_interval(values).low, 12.0);
  EXPECT_EQ(median_interval(values).high, 19.0);
  values.resize(6);
  EXPECT_EQ(median_interval(values).half_width(), 2.5);
  values.back() = std::nan("");
  EXPECT_TRUE(std::isnan(median_interval(values).low));
  EXPECT_TRUE(std::isnan(median_interval({}).high));
}

TEST(PearsonCorrelation, IsOneForAnyRisingLine) {
  EXPECT_NEAR(pearson_correlation(std::array{1.0, 2.0, 4.0}, std::array{3.0, 5.0, 9.0}), 1.0, 1e-15);
  EXPECT_NEAR(pearson_correlation(std::array{1.0, 2.0, 3.0}, std::array{1.0, -2.0, 1.0}), 0.0, 1e-15);
  EXPECT_TRUE(std::isnan(pearson_correlation(std::array{1.0, 1.0}, std::array{1.0, 2.0})));
}

TEST(PairedPValue, IsStudentsInClosedForm) {
  // Two degrees of freedom: p = 1 - t / sqrt(t^2 + 2), here t = 2 sqrt 3. One: p = 1 - 2 atan(t) / pi, here t = 1.
  EXPECT_NEAR(paired_p_value(std::array{1.0, 2.0, 3.0}), 1 - std::sqrt(12.0 / 14.0), 1e-12);
  EXPECT_NEAR(paired_p_value(std::array{-1.0, -2.0, -3.0}), 1 - std::sqrt(12.0 / 14.0), 1e-12);
  EXPECT_NEAR(paired_p_value(std::array{0.0, 2.0, std::nan("")}), 0.5, 1e-12);
}

TEST(PairedPValue, HasAnAnswerForFewAndForEqualDifferences) {
  EXPECT_TRUE(std::isnan(paired_p_value({})));
  EXPECT_TRUE(std::isnan(paired_p_value(std::array{1.0})));
  EXPECT_EQ(paired_p_value(std::array{0.0, 0.0}), 1.0);
  EXPECT_EQ(paired_p_value(std::array{0.5, 0.5}), 0.0);
}

// The example of Benjamini and Hochberg 1995, section 3: of 15 tests four are findings at 5 %, where Bonferroni's
// correction leaves three.
TEST(BenjaminiHochberg, GivesTheFindingsOfTheOriginalExample) {
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const auto q = benjamini_hochberg(p);
  EXPECT_EQ(std::ranges::count_if(q, [](double value) { return value <= 0.05; }), 4);
  EXPECT_NEAR(q[3], 0.0095 * 15 / 4, 1e-15);
  EXPECT_TRUE(std::ranges::is_sorted(q));
}

TEST(BenjaminiHochberg, DoesNotCountWhatWasNotTested) {
  const auto q = benjamini_hochberg(std::vector<double>{kNaN, 0.02, kNaN, 0.04});
  EXPECT_TRUE(std::isnan(q[0]));
  EXPECT_DOUBLE_EQ(q[1], 0.04);
  EXPECT_DOUBLE_EQ(q[3], 0.04);
}

/// The two-sided p-value of the rank sum from all ways to choose which values belong to the first sample.
double exact_rank_p(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all(a);
  all.insert(all.end(), b.begin(), b.end());
  const auto statistic = [&](unsigned chosen) {
    double u = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j)
        if ((chosen >> i & 1U) != 0 && (chosen >> j & 1U) == 0)
          u += all[i] > all[j] ? 1.0 : all[i] == all[j] ? 0.5 : 0.0;
    return std::abs(u - 0.5 * static_cast<double>(a.size() * b.size()));
  };
  const double seen = statistic((1U << a.size()) - 1U);
  double extreme = 0.0;
  double choices = 0.0;
  for (unsigned chosen = 0; chosen < (1U << all.size()); ++chosen) {
    if (std::popcount(chosen) != static_cast<int>(a.size())) continue;
    choices += 1.0;
    extreme += statistic(chosen) >= seen - 1e-9;
  }
  return extreme / choices;
}

TEST(RankTest, IsCloseToTheExactDistributionOfRanks) {
  const std::vector<double> a{1.1, 2.3, 2.9, 3.3, 4.1, 5.2, 6.0, 7.7};
  for (const double shift : {0.0, 1.0, 2.5, 4.0, 6.0}) {
    std::vector<double> b;
    for (const double v : a) b.push_back(v + shift + 0.05);
    // The ranks of eight and eight have 65 sums: the normal distribution is a few hundredths from steps of that size.
    EXPECT_NEAR(rank_p_value(a, b), exact_rank_p(a, b), 0.03) << shift;
  }
  EXPECT_NEAR(rank_p_value(a, std::vector<double>{2.9, 2.9, 3.3, 9.0, 9.0}), exact_rank_p(a, {2.9, 2.9, 3.3, 9.0, 9.0}),
              0.03);  // ties
  EXPECT_EQ(rank_p_value(std::vector<double>{1, 1}, std::vector<double>{1, 1, 1}), 1.0);
  EXPECT_TRUE(std::isnan(rank_p_value(std::vector<double>{kNaN}, a)));
}

TEST(SeedInterval, OfFewValuesIsTheirRange) {
  const MeanInterval few = seed_interval(std::array{0.5, 0.97, 1.0}, ValueRange::share);
  EXPECT_NEAR(few.mean, 2.47 / 3, 1e-12);
  EXPECT_EQ(few.low, 0.5);
  EXPECT_EQ(few.high, 1.0);
  EXPECT_EQ(seed_interval(std::array{2.0}, ValueRange::any).low, 2.0);
  EXPECT_TRUE(std::isnan(seed_interval({}, ValueRange::any).mean));
}

TEST(SeedInterval, StaysWithinTheRangeOfTheValuesAndHoldsTheMean) {
  // Six values with mean 0.05 or 0.95, of which t(0.975, 5) s / sqrt(6) = 2.5706 * 0.05 = 0.1285 reaches beyond 0 or 1.
  const std::array rare{0.0, 0.0, 0.0, 0.0, 0.0, 0.3}, most{1.0, 1.0, 1.0, 1.0, 1.0, 0.7};
  EXPECT_LT(mean_interval(rare).low, 0.0);
  const double stretch = std::exp(student_quantile(0.975, 5) * 0.05 / (0.05 * 0.95));
  for (const ValueRange range : {ValueRange::share, ValueRange::not_negative}) {
    const MeanInterval interval = seed_interval(rare, range);
    EXPECT_GE(interval.low, 0.0);
    EXPECT_LT(interval.low, 0.05);
    EXPECT_GT(interval.high, 0.05);
  }
  const MeanInterval high = seed_interval(most, ValueRange::share), low = seed_interval(rare, ValueRange::share);
  EXPECT_LE(high.high, 1.0);
  EXPECT_GE(high.high, 19 * stretch / (1 + 19 * stretch) - 1e-9);  // odds 19, stretched on the scale of the logit
  EXPECT_NEAR(high.low, 1 - low.high, 1e-9);                       // a share and its complement
}

}  // namespace
}  // namespace scanbench::results
