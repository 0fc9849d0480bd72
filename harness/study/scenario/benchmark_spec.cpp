// Reads and writes the specification of a benchmark page.
#include "harness/study/scenario/benchmark_spec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/study/catalog/chain.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::study {
namespace {

std::vector<std::string> scenario_names(const std::vector<Scenario>& scenarios) {
  std::vector<std::string> names;
  names.reserve(scenarios.size());
  for (const auto& scenario : scenarios) names.push_back(scenario.name);
  return names;
}

std::vector<std::string> pipeline_names(const Scenario& scenario) {
  std::vector<std::string> names;
  names.reserve(scenario.pipelines.size());
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

std::string metric_fault(const Scenario& scenario, const BenchmarkSubject& subject) {
  const auto missing =
      std::ranges::find_if(subject.required, [&](const auto& metric) { return !has_metric(scenario, metric); });
  if (missing == subject.required.end()) return "";
  std::vector<std::string> allowed;
  allowed.reserve(subject.required.size());
  for (const auto& required : subject.required) allowed.push_back(text_of(required));
  return fmt::format("{} has no metric {}; allowed: a benchmark of scenarios with the metrics {}", scenario.name,
                     name_of(*missing), fmt::join(allowed, ", "));
}

std::string slot_fault(const Scenario& scenario, const std::string& slot) {
  for (const auto& pipeline : scenario.pipelines)
    if (!has_slot(pipeline, slot))
      return fmt::format("{} of {} has no slot {}; allowed: a benchmark of pipelines that have it", pipeline.name,
                         scenario.name, slot);
  return "";
}

/// What keeps the modules of a slot in these scenarios from a benchmark; empty if nothing does.
std::string scenario_fault(const std::vector<Scenario>& scenarios, const std::string& slot) {
  const std::vector<std::string> pipelines = pipeline_names(scenarios.front());
  for (const auto& scenario : scenarios) {
    if (pipeline_names(scenario) != pipelines)
      return fmt::format("{} and {} have different pipelines; allowed: a benchmark of scenarios with the same ones",
                         scenarios.front().name, scenario.name);
    if (!std::holds_alternative<SimulatedInput>(scenario.input))
      return fmt::format("{} is not simulated; allowed: scenarios with a world, a sensor and a trajectory",
                         scenario.name);
    if (const std::string fault = slot_fault(scenario, slot); !fault.empty()) return fault;
    if (const std::string fault = metric_fault(scenario, benchmark_subject(slot)); !fault.empty()) return fault;
  }
  return "";
}

/// "no scenario is called x; known: a, b"; empty if one is.
std::string name_fault(const std::string& thing, const std::string& name, const std::vector<std::string>& known) {
  return std::ranges::count(known, name) > 0
             ? ""
             : fmt::format("no {} is called {}{}", thing, name, known_names(name, known));
}

}  // namespace

BenchmarkSpec read_benchmark(const io::YamlNode& node, const std::vector<Scenario>& scenarios) {
  io::YamlMap map(node, "benchmark");
  BenchmarkSpec spec;
  const io::YamlNode* of = map.find("of");
  spec.of = map.text_or("of", spec.of);
  if (const auto slots = benchmark_slots(); std::ranges::find(slots, spec.of) == slots.end())
    throw io::PlacedError(
        of->mark, fmt::format("no benchmark ranks modules of the kind {}{}", spec.of, known_names(spec.of, slots)));
  const io::YamlNode& baseline = map.require("baseline", "a pipeline's name");
  spec.baseline = map.text("baseline", "a pipeline's name");
  spec.example = map.text_or("example", scenarios.front().name);
  const io::YamlNode* example = map.find("example");
  map.done();
  const auto refuse = [](const std::string& fault, const io::YamlNode& at) {
    if (!fault.empty()) throw io::PlacedError(at.mark, fault);
  };
  refuse(scenario_fault(scenarios, spec.of), node);
  refuse(name_fault("pipeline", spec.baseline, pipeline_names(scenarios.front())), baseline);
  if (example != nullptr) refuse(name_fault("scenario", spec.example, scenario_names(scenarios)), *example);
  return spec;
}

std::string benchmark_fault(const BenchmarkSpec& spec, const std::vector<Scenario>& scenarios) {
  if (scenarios.empty()) return "";
  const std::vector<std::string> names = scenario_names(scenarios);
  std::string fault = scenario_fault(scenarios, spec.of);
  if (fault.empty()) fault = name_fault("pipeline", spec.baseline, pipeline_names(scenarios.front()));
  if (fault.empty()) fault = name_fault("scenario", spec.example, names);
  for (const auto& level : spec.levels)
    for (const auto& name : level.scenarios)
      if (fault.empty()) fault = name_fault("scenario", name, names);
  return fault;
}

std::string benchmark_json(const BenchmarkSpec& spec) {
  nlohmann::ordered_json json{
      {"about", spec.about}, {"of", spec.of}, {"baseline", spec.baseline}, {"example", spec.example}};
  auto& levels = json["levels"] = nlohmann::ordered_json::array();
  for (const auto& level : spec.levels)
    levels.push_back({{"factor", level.factor}, {"level", level.level}, {"scenarios", level.scenarios}});
  return io::json_text(json) + "\n";
}

}  // namespace scanbench::study
