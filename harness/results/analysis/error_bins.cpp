// Sums errors by bin and seed, and summarizes each bin.
#include "harness/results/analysis/error_bins.hpp"

#include <cmath>

#include "core/error.hpp"
#include "harness/results/analysis/statistics.hpp"

namespace scanbench::results {

ErrorBins::ErrorBins(double first, double ratio) : first_(first), log_ratio_(std::log(ratio)) {
  SCANBENCH_ASSERT(first > 0 && ratio > 1);
}

void ErrorBins::add(std::uint64_t seed, double x, double error, double bound) {
  if (!(x > 0) || !std::isfinite(x) || !std::isfinite(error) || !std::isfinite(bound)) return;
  Sums& sums = bins_[static_cast<int>(std::floor(std::log(x / first_) / log_ratio_))][seed];
  sums.x += x;
  sums.squared_error += error * error;
  sums.squared_bound += bound * bound;
  ++sums.count;
}

std::vector<ErrorPoint> ErrorBins::points(std::int64_t least) const {
  std::vector<ErrorPoint> points;
  for (const auto& [bin, seeds] : bins_) {
    ErrorPoint point;
    double squared_bound = 0.0;
    std::vector<double> log_rms;
    for (const auto& [seed, sums] : seeds) {
      point.x += sums.x;
      squared_bound += sums.squared_bound;
      point.count += sums.count;
      log_rms.push_back(0.5 * std::log(sums.squared_error / static_cast<double>(sums.count)));
    }
    if (point.count < least) continue;
    const auto count = static_cast<double>(point.count);
    const MeanInterval interval = mean_interval(log_rms);  // skips seeds without any error
    point.x /= count;
    point.bound = std::sqrt(squared_bound / count);
    point.rms = std::exp(interval.mean);
    point.low = std::exp(interval.low);
    point.high = std::exp(interval.high);
    points.push_back(point);
  }
  return points;
}

}  // namespace scanbench::results
