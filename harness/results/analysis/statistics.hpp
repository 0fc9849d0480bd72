// Summaries of a metric over seeds, with intervals that keep their coverage for few seeds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scanbench::results {

/// A mean with a 95 % confidence interval; low = high = mean for fewer than two values, all NaN for none.
struct MeanInterval {
  double mean;
  double low;
  double high;
  std::int64_t count;

  double half_width() const { return 0.5 * (high - low); }
};

/// The wider, at each end, of Student's t interval and a seeded bias-corrected and accelerated bootstrap (Efron 1987):
/// the percentile bootstrap alone covers too little below some twenty seeds. Of more than 400 values, where both agree
/// to within the bootstrap's own noise, Student's t interval alone. NaN values are left out.
MeanInterval mean_interval(std::span<const double> all);

/// Two-sided p-value of Student's t test that the mean of the differences of pairs is zero. NaN for fewer than two
/// values; 0 or 1 for differences without spread. NaN values are left out.
double paired_p_value(std::span<const double> all);

/// Where values can lie.
enum class ValueRange { any, not_negative, share };

constexpr std::int64_t kFewestForInterval = 6;

/// mean_interval() of values in a range, within that range: Student's t interval is taken of the logarithm of the mean,
/// or of the logit for shares, by the delta method. Of fewer than kFewestForInterval values low and high are the
/// smallest and the largest one: so few say little about their spread.
MeanInterval seed_interval(std::span<const double> all, ValueRange range);

/// The same after Benjamini and Hochberg, "Controlling the false discovery rate", Journal of the Royal Statistical
/// Society B 1995: of the tests whose corrected value is at most 0.05, on average at most 5 % are false alarms; if
/// nothing has changed, there is an alarm in at most 5 % of all cases.
std::vector<double> benjamini_hochberg(std::span<const double> p_values);

/// Two-sided p-value of the rank test of Mann and Whitney (Annals of Mathematical Statistics 1947) that two samples
/// have one distribution, by its normal approximation with the correction for ties: for times, which have outliers and
/// no pairs. NaN if a sample has no finite value.
double rank_p_value(std::span<const double> a, std::span<const double> b);

double median(std::span<const double> all);  ///< NaN values left out; NaN for none

/// The interval between two of the values that contains the median of their distribution with at least 95 %
/// probability, for every distribution (of 20 values, the 6th and the 15th in order). Fewer than six values have none:
/// NaN.
struct MedianInterval {
  double low;
  double high;
  double half_width() const { return 0.5 * (high - low); }
};
MedianInterval median_interval(std::span<const double> all);  ///< NaN values left out

double pearson_correlation(std::span<const double> x,
                           std::span<const double> y);  ///< NaN for fewer than two pairs or no spread

}  // namespace scanbench::results
