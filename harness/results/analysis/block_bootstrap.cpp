// Draws blocks of neighbouring scans and computes both means from each draw.
#include "harness/results/analysis/block_bootstrap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

constexpr std::size_t kBlockResamples = 2000;
constexpr int kMostDraws = 10000;  // of which some may have no scan with a value
constexpr double kBlockTail = 0.025;

double block_mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values) {
  const double mean = block_mean(values);
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// Sums over some scans, from which both means follow.
struct Sums {
  std::array<double, 4> of{};  // weighted values and weights, before and after

  void add(const ScanPair& pair, ScanMean mean) {
    const auto power = [&](double v) { return mean == ScanMean::mean ? v : v * v; };
    if (pair.weight_before > 0) {
      of[0] += pair.weight_before * power(pair.before);
      of[1] += pair.weight_before;
    }
    if (pair.weight_after > 0) {
      of[2] += pair.weight_after * power(pair.after);
      of[3] += pair.weight_after;
    }
  }
  double before(ScanMean mean) const { return root(of[0] / of[1], mean); }
  double after(ScanMean mean) const { return root(of[2] / of[3], mean); }

 private:
  /// Differences of sums of squares can be a rounding error below 0.
  static double root(double value, ScanMean mean) {
    return mean == ScanMean::mean ? value : std::sqrt(std::max(value, 0.0));
  }
};

/// Sums of the first k scans, for every k.
class RunningSums {
 public:
  RunningSums(std::span<const ScanPair> pairs, ScanMean mean) : sums_(pairs.size() + 1) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      sums_[i + 1] = sums_[i];
      sums_[i + 1].add(pairs[i], mean);
    }
  }
  void add(std::size_t first, std::size_t count, Sums& to) const {
    for (std::size_t k = 0; k < to.of.size(); ++k) to.of[k] += sums_[first + count].of[k] - sums_[first].of[k];
  }
  const Sums& all() const { return sums_.back(); }

 private:
  std::vector<Sums> sums_;
};

/// What every scan adds to the difference of the means (of the squares), to first order: for weights of 1 its own
/// difference, less their mean.
std::vector<double> influences(std::span<const ScanPair> pairs, ScanMean mean, const Sums& all) {
  const auto n = static_cast<double>(pairs.size());
  std::vector<double> influences;
  influences.reserve(pairs.size());
  for (const ScanPair& pair : pairs) {
    Sums one;
    one.add(pair, mean);
    const double before = (one.of[0] - one.of[1] * all.of[0] / all.of[1]) * n / all.of[1];
    const double after = (one.of[2] - one.of[3] * all.of[2] / all.of[3]) * n / all.of[3];
    influences.push_back(after - before);
  }
  return influences;
}

struct Drawn {
  double error = 0.0;  ///< standard error
  MeanInterval interval{};
};

/// The wider of the percentiles, moved so that the draws have the observed mean (blocks take the first and the last
/// scans less often than others), and of Student's t interval.
Drawn interval_of(std::vector<double> draws, double observed, std::size_t scans, double freedom) {
  const auto count = static_cast<std::int64_t>(scans);
  if (draws.size() < kBlockResamples) return {kInf, {observed, -kInf, kInf, count}};  // hardly any scan has a value
  const double centre = block_mean(draws);
  const double error = deviation_of(draws);
  std::ranges::sort(draws);
  const auto percentile = [&](double share) {
    return observed + draws[static_cast<std::size_t>(share * static_cast<double>(kBlockResamples - 1))] - centre;
  };
  const double reach = student_quantile(1.0 - kBlockTail, freedom) * error;
  return {error,
          {observed, std::min(percentile(kBlockTail), observed - reach),
           std::max(percentile(1.0 - kBlockTail), observed + reach), count}};
}

double p_value(double observed, double error, double freedom) {
  if (std::isnan(observed)) return kNaN;
  if (!(error > 0)) return observed == 0.0 ? 1.0 : 0.0;
  return student_two_sided(observed / error, freedom);
}

bool is_equal(const ScanPair& pair) {
  return pair.weight_before == pair.weight_after && (pair.weight_before == 0.0 || pair.before == pair.after);
}

/// Autocovariances of a series, up to a lag.
std::vector<double> autocovariances(std::span<const double> series, std::size_t lags) {
  const double mean = block_mean(series);
  std::vector<double> covariances(lags + 1, 0.0);
  for (std::size_t k = 0; k <= lags && k < series.size(); ++k) {
    for (std::size_t i = 0; i + k < series.size(); ++i) covariances[k] += (series[i] - mean) * (series[i + k] - mean);
    covariances[k] /= static_cast<double>(series.size());
  }
  return covariances;
}

/// The lag from which on the autocorrelation is not distinguishable from zero on `in_a_row` lags, at least 1.
std::size_t vanishing_lag(std::span<const double> covariances, std::size_t in_a_row, double threshold) {
  std::size_t last = 0;
  for (std::size_t k = 1; k < covariances.size() && k <= last + in_a_row; ++k)
    if (std::fabs(covariances[k]) > threshold * covariances[0]) last = k;
  return std::max<std::size_t>(last, 1);
}

}  // namespace

std::size_t block_length(std::span<const double> series) {
  const auto n = static_cast<double>(series.size());
  const bool is_constant = std::ranges::all_of(series, [&](double v) { return v == series.front(); });
  if (series.size() < 3 || is_constant) return 1;
  // Politis and White, section 3.2: constants c = 2 and K_n = max(5, sqrt(log10 n)), the flat-top window of their
  // equation 8, and G, D_CB of theorem 3.3.
  const auto in_a_row = static_cast<std::size_t>(std::max(5.0, std::sqrt(std::log10(n))));
  const std::size_t most = static_cast<std::size_t>(std::ceil(std::sqrt(n))) + in_a_row;
  const std::vector<double> covariances = autocovariances(series, std::min(most, series.size() - 1));
  const std::size_t lag = vanishing_lag(covariances, in_a_row, 2.0 * std::sqrt(std::log10(n) / n));
  const std::size_t width = std::min(2 * lag, covariances.size() - 1);
  double spectrum = covariances[0];
  double slope = 0.0;
  for (std::size_t k = 1; k <= width; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(width);
    const double window = t <= 0.5 ? 1.0 : 2.0 * (1.0 - t);
    spectrum += 2.0 * window * covariances[k];
    slope += 2.0 * window * static_cast<double>(k) * covariances[k];
  }
  const double length = std::cbrt(2.0 * slope * slope / (4.0 / 3.0 * spectrum * spectrum) * n);
  const double longest = std::max(1.0, std::floor(std::min(3.0 * std::sqrt(n), n / 3.0)));
  return static_cast<std::size_t>(std::isfinite(length) ? std::clamp(std::ceil(length), 1.0, longest) : longest);
}

BlockInterval block_interval(std::span<const ScanPair> pairs, ScanMean mean,
                             const std::function<double(double)>& cost) {
  const std::size_t n = pairs.size();
  SCANBENCH_ASSERT(n >= kLeastScans);
  BlockInterval result;
  if (std::ranges::all_of(pairs, is_equal)) {
    result.difference = result.worsening = {0.0, 0.0, 0.0, static_cast<std::int64_t>(n)};
    return result;
  }
  const RunningSums sums(pairs, mean);
  const double before = sums.all().before(mean);
  const double after = sums.all().after(mean);
  const std::vector<double> added = influences(pairs, mean, sums.all());
  result.block = block_length(added);
  std::vector<double> differences, worsenings;
  CounterRng rng(0, RngStream::resampling, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(result.block));
  const auto starts = static_cast<double>(n - result.block + 1);
  for (int attempt = 0; attempt < kMostDraws && differences.size() < kBlockResamples; ++attempt) {
    Sums drawn;
    for (std::size_t taken = 0; taken < n; taken += result.block)
      sums.add(static_cast<std::size_t>(rng.uniform() * starts), std::min(result.block, n - taken), drawn);
    if (!(drawn.of[1] > 0 && drawn.of[3] > 0)) continue;  // none of these scans has a value
    differences.push_back(drawn.after(mean) - drawn.before(mean));
    worsenings.push_back(cost(drawn.after(mean)) - cost(drawn.before(mean)));
  }
  const double freedom = std::max(1.0, std::floor(static_cast<double>(n) / static_cast<double>(result.block)) - 1.0);
  result.difference = interval_of(std::move(differences), after - before, n, freedom).interval;
  const double worsening = cost(after) - cost(before);
  if (std::isnan(worsening)) {  // a metric without a better direction
    result.worsening = {kNaN, kNaN, kNaN, 0};
    result.p = kNaN;
  } else {
    const Drawn drawn = interval_of(std::move(worsenings), worsening, n, freedom);
    result.worsening = drawn.interval;
    result.p = p_value(worsening, drawn.error, freedom);
  }
  const double deviation = deviation_of(added);
  result.effect = deviation > 0 && mean == ScanMean::mean ? (after - before) / deviation : kNaN;
  return result;
}

}  // namespace scanbench::results
