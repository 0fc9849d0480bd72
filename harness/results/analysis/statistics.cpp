// Computes intervals of means and medians, tests of paired differences, and correlations.
#include "harness/results/analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/median.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

constexpr double kTail = 0.025;
constexpr int kResamples = 2000;
constexpr std::size_t kMostResampled = 400;  // values; the mean of more is as good as normal

std::vector<double> finite(std::span<const double> values) {
  std::vector<double> kept;
  for (const double v : values)
    if (std::isfinite(v)) kept.push_back(v);
  return kept;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

struct Ends {
  double low;
  double high;
};

Ends student_t(std::span<const double> values, double mean) {
  const auto n = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double reach = student_quantile(1.0 - kTail, n - 1.0) * std::sqrt(squares / (n - 1.0) / n);
  return {mean - reach, mean + reach};
}

// Efron, "Better bootstrap confidence intervals", JASA 1987, with the jackknife's acceleration.
Ends bca_bootstrap(std::span<const double> values, double mean) {
  const std::size_t n = values.size();
  std::vector<double> resampled(kResamples);
  CounterRng rng(0, RngStream::resampling, static_cast<std::uint32_t>(n));
  std::int64_t below = 0;
  std::int64_t equal = 0;
  for (double& r : resampled) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += values[static_cast<std::size_t>(rng.uniform() * static_cast<double>(n))];
    r = sum / static_cast<double>(n);
    below += r < mean ? 1 : 0;
    equal += r == mean ? 1 : 0;
  }
  std::ranges::sort(resampled);
  const double share = std::clamp((static_cast<double>(below) + 0.5 * static_cast<double>(equal)) / kResamples,
                                  1.0 / kResamples, 1.0 - 1.0 / kResamples);
  const double bias = normal_quantile(share);
  // The mean without value i differs from their mean by (mean - v_i) / (n - 1): the factor cancels in the acceleration.
  double cubes = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    cubes += std::pow(v - mean, 3);
    squares += (v - mean) * (v - mean);
  }
  if (squares == 0.0) return {mean, mean};
  const double acceleration = cubes / (6.0 * std::pow(squares, 1.5));
  const auto end = [&](double probability) {
    const double z = bias + normal_quantile(probability);
    const double adjusted = normal_probability(bias + z / (1.0 - acceleration * z));
    const auto index = static_cast<std::size_t>(std::clamp(adjusted * kResamples, 0.0, kResamples - 1.0));
    return resampled[index];
  };
  return {end(kTail), end(1.0 - kTail)};
}

}  // namespace

namespace {

/// Maps the ends back from the scale on which the range has no end. The slope of the scale at the mean stretches the
/// reach.
Ends within(ValueRange range, Ends ends, double mean) {
  const double reach = 0.5 * (ends.high - ends.low);
  if (range == ValueRange::share && mean > 0.0 && mean < 1.0) {
    const double odds = mean / (1.0 - mean), stretch = std::exp(reach / (mean * (1.0 - mean)));
    return {odds / (odds + stretch), odds / (odds + 1.0 / stretch)};
  }
  if (range == ValueRange::not_negative && mean > 0.0)
    return {mean * std::exp(-reach / mean), mean * std::exp(reach / mean)};
  return ends;
}

MeanInterval interval_within(std::span<const double> all, ValueRange range) {
  const std::vector<double> values = finite(all);
  const auto count = static_cast<std::int64_t>(values.size());
  if (values.empty()) return {kNaN, kNaN, kNaN, 0};
  const double mean = mean_of(values);
  const bool constant = std::ranges::all_of(values, [&](double v) { return v == values.front(); });
  if (constant) return {values.front(), values.front(), values.front(), count};
  const Ends t = within(range, student_t(values, mean), mean);
  if (values.size() > kMostResampled) return {mean, t.low, t.high, count};
  const Ends bootstrap = bca_bootstrap(values, mean);
  return {mean, std::min(t.low, bootstrap.low), std::max(t.high, bootstrap.high), count};
}

}  // namespace

MeanInterval mean_interval(std::span<const double> all) {
  return interval_within(all, ValueRange::any);
}

MeanInterval seed_interval(std::span<const double> all, ValueRange range) {
  const std::vector<double> values = finite(all);
  const auto count = static_cast<std::int64_t>(values.size());
  if (values.empty() || count >= kFewestForInterval) return interval_within(values, range);
  const auto [low, high] = std::ranges::minmax(values);
  return {mean_of(values), low, high, count};
}

double paired_p_value(std::span<const double> all) {
  const std::vector<double> values = finite(all);
  if (values.size() < 2) return kNaN;
  const auto n = static_cast<double>(values.size());
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  if (squares == 0.0) return mean == 0.0 ? 1.0 : 0.0;
  const double t = mean / std::sqrt(squares / (n - 1.0) / n);
  return student_two_sided(t, n - 1.0);
}

std::vector<double> benjamini_hochberg(std::span<const double> p_values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p_values.size(); ++i)
    if (std::isfinite(p_values[i])) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.begin(), p_values.end());
  double smallest = 1.0;
  for (std::size_t k = order.size(); k-- > 0;) {
    const double corrected = static_cast<double>(order.size()) / static_cast<double>(k + 1) * p_values[order[k]];
    smallest = std::min(smallest, corrected);
    adjusted[order[k]] = smallest;
  }
  return adjusted;
}

double rank_p_value(std::span<const double> a, std::span<const double> b) {
  struct Value {
    double value;
    bool of_a;
  };
  std::vector<Value> values;
  for (const double v : finite(a)) values.push_back({v, true});
  const auto n = static_cast<double>(values.size());
  for (const double v : finite(b)) values.push_back({v, false});
  const double m = static_cast<double>(values.size()) - n;
  if (n == 0 || m == 0) return kNaN;
  std::ranges::sort(values, {}, &Value::value);
  double rank_sum = 0.0;  // of a
  double ties = 0.0;      // sum of t^3 - t over groups of t equal values
  for (std::size_t first = 0; first < values.size();) {
    std::size_t last = first;
    while (last + 1 < values.size() && values[last + 1].value == values[first].value) ++last;
    const double rank = 0.5 * static_cast<double>(first + last) + 1.0;
    for (std::size_t i = first; i <= last; ++i) rank_sum += values[i].of_a ? rank : 0.0;
    const auto t = static_cast<double>(last - first + 1);
    ties += t * t * t - t;
    first = last + 1;
  }
  const double all = n + m;
  const double u = rank_sum - 0.5 * n * (n + 1.0);
  const double variance = n * m / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
  if (!(variance > 0)) return 1.0;
  const double z = std::max(0.0, std::fabs(u - 0.5 * n * m) - 0.5) / std::sqrt(variance);
  return normal_two_sided(z);
}

double median(std::span<const double> all) {
  return scanbench::median(finite(all));
}

MedianInterval median_interval(std::span<const double> all) {
  std::vector<double> values = finite(all);
  std::ranges::sort(values);
  const std::size_t n = values.size();
  // The number of values below the median is binomial(n, 1/2): the values of rank k and n + 1 - k do not enclose it
  // with probability 2 P(X < k).
  std::size_t k = 0;
  double term = std::pow(0.5, static_cast<double>(n));
  for (double below = term; below <= kTail && k < n / 2; below += term) {
    ++k;
    term *= static_cast<double>(n - k + 1) / static_cast<double>(k);
  }
  if (k == 0) return {kNaN, kNaN};
  return {values[k - 1], values[n - k]};
}

double pearson_correlation(std::span<const double> x, std::span<const double> y) {
  SCANBENCH_ASSERT(x.size() == y.size());
  std::vector<double> a, b;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    a.push_back(x[i]);
    b.push_back(y[i]);
  }
  if (a.size() < 2) return kNaN;
  const double ma = mean_of(a);
  const double mb = mean_of(b);
  double saa = 0.0, sbb = 0.0, sab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    saa += (a[i] - ma) * (a[i] - ma);
    sbb += (b[i] - mb) * (b[i] - mb);
    sab += (a[i] - ma) * (b[i] - mb);
  }
  return saa > 0 && sbb > 0 ? sab / std::sqrt(saa * sbb) : kNaN;
}

}  // namespace scanbench::results
