// Reads and writes the gates of a suite.
#include "harness/study/scenario/gate_spec.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/yaml/reader.hpp"
#include "metrics/metric.hpp"

namespace scanbench::study {

GateSpec read_gates(const io::YamlNode& node) {
  std::map<std::string, metrics::MetricDescription> descriptions;
  std::vector<std::string> known;
  for (const auto& [family, entry] : Registry<metrics::MetricFamily>::all())
    for (auto& description : entry.make({})->describe())
      if (descriptions.emplace(description.metric, description).second &&
          description.direction != metrics::Direction::neither)
        known.push_back(description.metric);
  constexpr const char* kAllowed = "metrics with their tolerances, as {f1: 0.005}";
  if (node.kind != io::YamlKind::map || node.entries.empty())
    throw io::PlacedError(node.mark, fmt::format("gates is {}; allowed: {}", io::describe_node(node), kAllowed));
  GateSpec spec;
  for (const auto& [metric, mark, value] : node.entries) {
    const auto found = descriptions.find(metric);
    if (found == descriptions.end())
      throw io::PlacedError(mark, fmt::format("there is no metric {}{}", metric, known_names(metric, known)));
    if (found->second.direction == metrics::Direction::neither)
      throw io::PlacedError(
          mark, fmt::format("no value of {} is better than another, so it cannot be a gate; allowed: {}", metric,
                            join(known)));
    const double tolerance = io::read_number(value, "the tolerance of " + metric, found->second.unit);
    if (!(tolerance >= 0))
      throw io::PlacedError(value.mark, fmt::format("the tolerance of {} is {}; allowed: >= 0", metric, value.text));
    spec.tolerances[metric] = tolerance;
  }
  return spec;
}

std::string gates_json(const GateSpec& spec) {
  nlohmann::ordered_json tolerances = nlohmann::ordered_json::object();
  for (const auto& [metric, tolerance] : spec.tolerances) tolerances[metric] = tolerance;
  return io::json_text({{"schema", 1}, {"gates", tolerances}}) + "\n";
}

}  // namespace scanbench::study
