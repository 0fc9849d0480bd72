// manifest.json, scenario.yaml, effective.yaml (or a folder of each) and benchmark.json of a run.
#include "harness/store/run_files.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/store/json_file.hpp"
#include "harness/store/run_file.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

const RunFile kScenarioFile("scenario.yaml");
const RunFile kEffectiveFile("effective.yaml");
const RunFile kScenarioFiles[] = {RunFile("scenarios/*.yaml"), RunFile("effective/*.yaml")};
const RunFile kBenchmarkFile("benchmark.json");

void write_scenarios(const fs::path& run, const RunStart& start) {
  if (start.scenarios.size() == 1) {
    write_file_atomically(run / kScenarioFile, start.scenarios.front().text);
    write_file_atomically(run / kEffectiveFile, start.effective_yaml(start.scenarios.front()));
    return;
  }
  make_folders(run / "scenarios");
  make_folders(run / "effective");
  for (const auto& scenario : start.scenarios) {
    write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
    write_file_atomically(run / "effective" / (scenario.name + ".yaml"), start.effective_yaml(scenario));
  }
}

}  // namespace

Manifest start_run(const RunTarget& target, const RunStart& start) {
  const fs::path& run = target.path();
  make_folders(run);
  Manifest manifest{"running", utc_now(), "", start.argv, {}, start.cells};
  for (const auto& scenario : start.scenarios) manifest.scenarios.push_back(scenario.name);
  write_manifest(run, manifest);  // with it the folder is ours
  if (start.benchmark)
    write_file_atomically(run / kBenchmarkFile, benchmark_json(*start.benchmark));
  else
    remove_file(run / kBenchmarkFile);
  write_scenarios(run, start);
  return manifest;
}

void end_run(RunTarget& target, Manifest& manifest, const std::string& state) {
  manifest.state = state;
  manifest.end = utc_now();
  write_manifest(target.path(), manifest);
  target.finish();
}

std::vector<Scenario> load_run_scenarios(const fs::path& run) {
  const Manifest manifest = load_manifest(run);
  std::vector<Scenario> scenarios;
  for (const auto& name : manifest.scenarios) {
    const fs::path alone = run / kEffectiveFile;
    const bool many = manifest.scenarios.size() > 1 || !fs::exists(alone);
    scenarios.push_back(load_scenario(many ? run / "effective" / (name + ".yaml") : alone));
    scenarios.back().name = name;
  }
  return scenarios;
}

std::optional<BenchmarkSpec> load_benchmark(const fs::path& run) {
  const fs::path path = run / kBenchmarkFile;
  if (!fs::exists(path)) return std::nullopt;
  const auto json = load_json_object(path);
  try {
    const BenchmarkSpec spec{json.at("about"), json.at("baseline"), json.at("example"), json.value("of", "extract")};
    if (const auto slots = benchmark_slots(); std::ranges::find(slots, spec.of) == slots.end())
      throw ConfigError(path.string() + ": no benchmark ranks modules of the kind " + spec.of);
    return spec;
  } catch (const nlohmann::json::exception& error) {
    refuse_json(path, error);
  }
}

}  // namespace scanbench::harness
