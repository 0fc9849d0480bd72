// run() with the real recordings, and the scenarios that a run folder holds.
#include "harness/run_scenarios.hpp"

#include "harness/atomic_file.hpp"
#include "harness/scenario.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options) {
  return run_with(
      scenarios, options,
      {.recording = [](const Scenario& s, std::uint64_t seed, int threads) { return make_recording(s, seed, threads); },
       .effective_yaml = effective_yaml});
}

void write_run_scenarios(const fs::path& run, const std::vector<Scenario>& scenarios, const RunServices& services) {
  if (scenarios.size() == 1) {
    write_file_atomically(run / "scenario.yaml", scenarios.front().text);
    write_file_atomically(run / "effective.yaml", services.effective_yaml(scenarios.front()));
    return;
  }
  make_folders(run / "scenarios");
  make_folders(run / "effective");
  for (const auto& scenario : scenarios) {
    write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
    write_file_atomically(run / "effective" / (scenario.name + ".yaml"), services.effective_yaml(scenario));
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
