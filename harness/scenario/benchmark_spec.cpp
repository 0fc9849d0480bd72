// Reads and writes the specification of a benchmark page.
#include "harness/scenario/benchmark_spec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/scenario/chain.hpp"
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

/// "segments", "{name: efficiency, params: {matches: true}}"
std::string text_of(const RequiredMetric& required) {
  return required.parameter.empty()
             ? required.family
             : fmt::format("{{name: {}, params: {{{}: true}}}}", required.family, required.parameter);
}

/// "segments", "efficiency with matches"
std::string name_of(const RequiredMetric& required) {
  return required.parameter.empty() ? required.family : required.family + " with " + required.parameter;
}

bool has_metric(const Scenario& scenario, const RequiredMetric& required) {
  const auto choice = std::ranges::find(scenario.metrics, required.family, &ModuleChoice::module);
  return choice != scenario.metrics.end() &&
         (required.parameter.empty() || std::get<bool>(choice->params.at(required.parameter)));
}

void check_metrics(const Scenario& scenario, const BenchmarkSubject& subject, Mark mark) {
  const auto missing =
      std::ranges::find_if(subject.required, [&](const auto& metric) { return !has_metric(scenario, metric); });
  if (missing == subject.required.end()) return;
  std::vector<std::string> allowed;
  for (const auto& required : subject.required) allowed.push_back(text_of(required));
  throw PlacedError(mark, fmt::format("{} has no metric {}; allowed: a benchmark of scenarios with the metrics {}",
                                      scenario.name, name_of(*missing), fmt::join(allowed, ", ")));
}

void check_slots(const Scenario& scenario, const std::string& slot, Mark mark) {
  for (const auto& pipeline : scenario.pipelines)
    if (!has_slot(pipeline, slot))
      throw PlacedError(mark, fmt::format("{} of {} has no slot {}; allowed: a benchmark of pipelines that have it",
                                          pipeline.name, scenario.name, slot));
}

}  // namespace

BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios) {
  YamlMap map(node, "benchmark");
  BenchmarkSpec spec;
  const YamlNode* of = map.find("of");
  spec.of = map.text_or("of", spec.of);
  if (const auto slots = benchmark_slots(); std::ranges::find(slots, spec.of) == slots.end())
    throw PlacedError(of->mark,
                      fmt::format("no benchmark ranks modules of the kind {}{}", spec.of, known_names(spec.of, slots)));
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
    check_slots(scenario, spec.of, node.mark);
    check_metrics(scenario, spec.subject(), node.mark);
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
  nlohmann::ordered_json json{
      {"about", spec.about}, {"of", spec.of}, {"baseline", spec.baseline}, {"example", spec.example}};
  auto& levels = json["levels"] = nlohmann::ordered_json::array();
  for (const auto& level : spec.levels)
    levels.push_back({{"factor", level.factor}, {"level", level.level}, {"scenarios", level.scenarios}});
  return json.dump(2) + "\n";
}

}  // namespace scanbench::harness
