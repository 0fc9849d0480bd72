// Compares the values of a metric scan by scan.
#include "harness/results/analysis/scan_change.hpp"

#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "harness/results/analysis/gates.hpp"

namespace scanbench::results {
namespace {

using metrics::MetricDescription;

/// How much worse the scan became; 0 where it has no value in one of the runs.
double worsening(const MetricDescription& metric, double before, double after) {
  if (!std::isfinite(before) || !std::isfinite(after)) return 0.0;
  const double change = metrics::cost(metric, after) - metrics::cost(metric, before);
  return std::isnan(change) ? std::fabs(after - before) : change;
}

/// A value that is lost counts only if no other changed: that F1 is undefined where nothing is true and nothing was
/// found is no fault.
std::optional<std::size_t> most_changed(const std::vector<double>& before, const std::vector<double>& after,
                                        const MetricDescription& metric) {
  std::size_t worst = 0, most = 0;
  double worst_by = 0.0, most_by = 0.0;
  std::optional<std::size_t> lost;
  for (std::size_t f = 0; f < before.size(); ++f) {
    const double change = worsening(metric, before[f], after[f]);
    if (change > worst_by) std::tie(worst, worst_by) = std::pair(f, change);
    if (std::fabs(change) > most_by) std::tie(most, most_by) = std::pair(f, std::fabs(change));
    if (!lost && std::isfinite(before[f]) && !std::isfinite(after[f])) lost = f;
  }
  if (worst_by > 0.0) return worst;
  return most_by > 0.0 ? most : lost;
}

std::optional<ScanChange> largest_change(const std::vector<double>& before, const std::vector<double>& after,
                                         const MetricDescription& metric) {
  if (before.size() != after.size()) return std::nullopt;
  const auto frame = most_changed(before, after, metric);
  if (!frame) return std::nullopt;
  return ScanChange{*frame, before.size(), metric, false, before[*frame], after[*frame]};
}

}  // namespace

std::optional<ScanChange> most_changed_scan(ScanValueReader& before, ScanValueReader& after, const runs::CellKey& key,
                                            const MetricDescription& metric) {
  const auto change_of = [&](const MetricDescription& shown) -> std::optional<ScanChange> {
    const auto earlier = before.by_scan(key, shown.metric);
    const auto later = after.by_scan(key, shown.metric);
    return earlier && later ? largest_change(*earlier, *later, shown) : std::nullopt;
  };
  if (const auto change = change_of(metric)) return change;
  const std::map<std::string, MetricDescription> descriptions = metric_descriptions();
  for (const std::string& headline : headline_metrics()) {
    if (headline == metric.metric) continue;
    auto change = change_of(descriptions.at(headline));
    if (!change) continue;
    change->substitute = true;
    return change;
  }
  return std::nullopt;
}

}  // namespace scanbench::results
