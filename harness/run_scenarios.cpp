// run() with the real recordings, and the scenarios that a run folder holds.
#include "harness/runner.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options) {
  return run_with(
      scenarios, options,
      {.recording = [](const Scenario& s, std::uint64_t seed, int threads) { return make_recording(s, seed, threads); },
       .effective_yaml = effective_yaml});
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
