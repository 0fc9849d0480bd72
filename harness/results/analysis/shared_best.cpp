// Compares the costs of methods with those of the best, seed by seed.
#include "harness/results/analysis/shared_best.hpp"

#include <cmath>
#include <cstddef>

#include "core/index.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using metrics::MetricDescription;

/// +1 or -1: the sign with which the cost changes with the value, near this mean.
double slope_of_cost(const MetricDescription& metric, double mean) {
  if (metric.direction == Direction::target) return mean < metric.target ? -1.0 : 1.0;
  return metric.direction == Direction::higher_is_better ? -1.0 : 1.0;
}

bool is_behind(const std::vector<double>& values, double mean, const std::vector<double>& best, double best_mean,
               const MetricDescription& metric) {
  if (values.size() != best.size()) return false;
  const double slope = slope_of_cost(metric, mean), best_slope = slope_of_cost(metric, best_mean);
  std::vector<double> behind_by;
  behind_by.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    behind_by.push_back(slope * (values[k] - metric.target) - best_slope * (best[k] - metric.target));
  return seed_interval(behind_by, ValueRange::any).low > 0.0;
}

}  // namespace

ValueRange range_of(const MetricDescription& metric) {
  return metric.is_share ? ValueRange::share : ValueRange::not_negative;
}

std::vector<int> shared_best(const std::vector<std::vector<double>>& seeds, const MetricDescription& metric,
                             const std::vector<bool>& eligible) {
  if (metric.direction == Direction::neither) return {};
  std::vector<double> means;
  means.reserve(seeds.size());
  int best = -1;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const bool may_win = eligible.empty() || eligible[i];
    means.push_back(may_win ? seed_interval(seeds[i], ValueRange::any).mean : std::nan(""));
    if (std::isfinite(means[i]) && (best < 0 || better(metric, means[i], means[as_index(best)])))
      best = static_cast<int>(i);
  }
  if (best < 0) return {};
  std::vector<int> shared{best};
  for (int i = 0; i < static_cast<int>(seeds.size()); ++i)
    if (i != best && std::isfinite(means[as_index(i)]) &&
        !is_behind(seeds[as_index(i)], means[as_index(i)], seeds[as_index(best)], means[as_index(best)], metric))
      shared.push_back(i);
  return shared;
}

}  // namespace scanbench::results
