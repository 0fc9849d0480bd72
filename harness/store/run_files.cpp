// Writes and loads the scenario files of a run: scenario.yaml and effective.yaml, or a folder of each.
#include "harness/store/run_files.hpp"

#include "harness/files/atomic_file.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/store/manifest.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

void write_run_scenarios(const fs::path& run, const std::vector<Scenario>& scenarios,
                         const std::function<std::string(const Scenario&)>& effective_yaml) {
  if (scenarios.size() == 1) {
    write_file_atomically(run / "scenario.yaml", scenarios.front().text);
    write_file_atomically(run / "effective.yaml", effective_yaml(scenarios.front()));
    return;
  }
  make_folders(run / "scenarios");
  make_folders(run / "effective");
  for (const auto& scenario : scenarios) {
    write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
    write_file_atomically(run / "effective" / (scenario.name + ".yaml"), effective_yaml(scenario));
  }
}

std::vector<Scenario> load_run_scenarios(const fs::path& run) {
  const Manifest manifest = load_manifest(run);
  std::vector<Scenario> scenarios;
  for (const auto& name : manifest.scenarios) {
    const fs::path alone = run / "effective.yaml";
    const bool many = manifest.scenarios.size() > 1 || !fs::exists(alone);
    scenarios.push_back(load_scenario(many ? run / "effective" / (name + ".yaml") : alone));
    scenarios.back().name = name;
  }
  return scenarios;
}

}  // namespace scanbench::harness
