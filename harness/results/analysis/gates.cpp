// Applies a suite's gates to the metrics of the registered families.
#include "harness/results/analysis/gates.hpp"

#include "core/registry.hpp"

namespace scanbench::results {

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
    const bool by_default = description.direction != Direction::neither && !description.timing;
    is_gate_[metric] = spec.tolerances.empty() ? by_default : given != spec.tolerances.end();
  }
}

bool Gates::is_gate(const std::string& metric) const {
  const auto found = is_gate_.find(metric);
  return found != is_gate_.end() && found->second;
}

const MetricDescription& Gates::description(const std::string& metric) const {
  static const MetricDescription kUnknown{};
  const auto found = descriptions_.find(metric);
  return found == descriptions_.end() ? kUnknown : found->second;
}

}  // namespace scanbench::results
