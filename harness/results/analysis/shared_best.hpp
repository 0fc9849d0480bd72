// Which of several methods share the best value of a metric over seeds.
#pragma once

#include <vector>

#include "harness/results/analysis/statistics.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// The range of a metric's values.
ValueRange range_of(const metrics::MetricDescription& metric);

/// The method with the best mean, then in their order those that the seeds do not separate from it: whose cost minus
/// that of the best, seed by seed, has a seed_interval() that contains zero. Of fewer than kFewestForInterval seeds
/// that is: which are not behind on every seed. Empty if the metric has no best value or no method has one.
/// `seeds`: the values of each method in one order of seeds, NaN: no value. `eligible`, one entry per method: which may
/// be best; empty: all.
std::vector<int> shared_best(const std::vector<std::vector<double>>& seeds, const metrics::MetricDescription& metric,
                             const std::vector<bool>& eligible = {});

}  // namespace scanbench::results
