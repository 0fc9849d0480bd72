// Reads and writes the specification of a benchmark page.
#include "harness/scenario/benchmark_spec.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/yaml/reader.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> scenario_names(const std::vector<Scenario>& scenarios) {
  std::vector<std::string> names;
  for (const auto& scenario : scenarios) names.push_back(scenario.name);
  return names;
}

std::vector<std::string> pipeline_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& pipeline : scenario.pipelines) names.push_back(pipeline.name);
  return names;
}

void check_metrics(const Scenario& scenario, Mark mark) {
  for (const std::string family : {"segments", "efficiency", "timing"}) {
    const auto choice = std::ranges::find(scenario.metrics, family, &ModuleChoice::module);
    const bool writes_matches =
        choice != scenario.metrics.end() && (family != "efficiency" || std::get<bool>(choice->params.at("matches")));
    if (!writes_matches)
      throw PlacedError(mark, fmt::format("{} has no metric {}; allowed: a benchmark of scenarios with the metrics "
                                          "segments, {{name: efficiency, params: {{matches: true}}}} and timing",
                                          scenario.name, family == "efficiency" ? "efficiency with matches" : family));
  }
}

}  // namespace

BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios) {
  YamlMap map(node, "benchmark");
  BenchmarkSpec spec;
  const YamlNode& baseline = map.require("baseline", "a pipeline's name");
  spec.baseline = map.text("baseline", "a pipeline's name");
  spec.example = map.text_or("example", scenarios.front().name);
  const YamlNode* example = map.find("example");
  map.done();
  const std::vector<std::string> pipelines = pipeline_names(scenarios.front());
  for (const auto& scenario : scenarios) {
    if (pipeline_names(scenario) != pipelines)
      throw PlacedError(node.mark,
                        fmt::format("{} and {} have different pipelines; allowed: a benchmark of scenarios with "
                                    "the same ones",
                                    scenarios.front().name, scenario.name));
    if (!std::holds_alternative<SimulatedInput>(scenario.input))
      throw PlacedError(node.mark,
                        fmt::format("{} is not simulated; allowed: scenarios with a world, a sensor and a trajectory",
                                    scenario.name));
    check_metrics(scenario, node.mark);
  }
  if (std::ranges::find(pipelines, spec.baseline) == pipelines.end())
    throw PlacedError(baseline.mark,
                      fmt::format("no pipeline is called {}{}", spec.baseline, known_names(spec.baseline, pipelines)));
  const std::vector<std::string> names = scenario_names(scenarios);
  if (std::ranges::find(names, spec.example) == names.end())
    throw PlacedError(example->mark,
                      fmt::format("no scenario is called {}{}", spec.example, known_names(spec.example, names)));
  return spec;
}

std::string benchmark_json(const BenchmarkSpec& spec) {
  const nlohmann::ordered_json json{{"about", spec.about}, {"baseline", spec.baseline}, {"example", spec.example}};
  return json.dump(2) + "\n";
}

}  // namespace scanbench::harness
