// Applies a suite's gates to the metrics of the registered families.
#include "harness/results/analysis/gates.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/registry.hpp"

namespace scanbench::results {
namespace {

/// The headlines of what a pipeline makes, the result of its last stage first. The first entry of which it has a metric
/// decides. The last ones need no truth.
const std::vector<std::vector<std::string_view>> kHeadlines{
    {"covered_5cm", "true_share_5cm"},              // a map: its right and its false length
    {"position_error", "heading_error"},            // aligned scans
    {"pose_error_position", "pose_error_heading"},  // matched scans
    {"ate_position", "ate_heading"},                // a trajectory
    {"relations_position", "relations_heading"},    // a trajectory of a recorded log
    {"f1"},                                         // lines of scans
    {"missed", "spurious"},
    {"D_M"},
    {"d_mean"}};

}  // namespace

using metrics::Direction;
using metrics::MetricDescription;

std::map<std::string, MetricDescription> metric_descriptions() {
  std::map<std::string, MetricDescription> all;
  for (const auto& [name, entry] : Registry<metrics::MetricFamily>::all())
    for (auto& description : entry.make({})->describe()) all.emplace(description.metric, description);
  return all;
}

Gates::Gates(const study::GateSpec& spec) : descriptions_(metric_descriptions()) {
  for (auto& [metric, description] : descriptions_) {
    const auto given = spec.tolerances.find(metric);
    if (given != spec.tolerances.end()) description.tolerance = given->second;
    if (given != spec.tolerances.end()) named_.insert(metric);
  }
}

std::set<std::string> Gates::among(const std::set<std::string>& metrics) const {
  std::set<std::string> gates;
  if (!named_.empty()) {
    std::ranges::set_intersection(metrics, named_, std::inserter(gates, gates.end()));
    return gates;
  }
  for (const auto& headlines : kHeadlines) {
    for (const std::string_view metric : headlines)
      if (metrics.contains(std::string(metric))) gates.emplace(metric);
    if (!gates.empty()) break;
  }
  return gates;
}

bool Gates::is_judged(const std::string& metric) const {
  const MetricDescription& known = description(metric);
  return named_.contains(metric) || (known.direction != Direction::neither && !known.timing);
}

std::vector<std::string> headline_metrics() {
  std::vector<std::string> metrics;
  for (const auto& headlines : kHeadlines) metrics.insert(metrics.end(), headlines.begin(), headlines.end());
  return metrics;
}

bool is_headline(const std::string& metric) {
  return std::ranges::any_of(
      kHeadlines, [&](const auto& headlines) { return std::ranges::find(headlines, metric) != headlines.end(); });
}

const MetricDescription& Gates::description(const std::string& metric) const {
  static const MetricDescription kUnknown{};
  const auto found = descriptions_.find(metric);
  return found == descriptions_.end() ? kUnknown : found->second;
}

}  // namespace scanbench::results
