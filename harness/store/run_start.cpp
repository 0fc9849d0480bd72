// The first and the last files of a run.
#include "harness/store/run_start.hpp"

#include "harness/files/atomic_file.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

Manifest start_run(const RunTarget& target, const RunStart& start) {
  const fs::path& run = target.path();
  make_folders(run);
  Manifest manifest{"running", utc_now(), "", start.argv, {}, start.cells};
  for (const auto& scenario : start.scenarios) manifest.scenarios.push_back(scenario.name);
  write_manifest(run, manifest);  // with it the folder is ours
  write_suite_rules(run, start.rules);
  write_run_scenarios(run, start.scenarios, start.effective_yaml);
  return manifest;
}

void end_run(RunTarget& target, Manifest& manifest, const std::string& state, bool reports_follow) {
  manifest.state = state;
  manifest.end = utc_now();
  write_manifest(target.path(), manifest);
  if (reports_follow) set_run_state(target.path(), "running");
  target.finish();
}

}  // namespace scanbench::harness
