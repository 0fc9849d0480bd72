// The first and the last files of a run.
#include "harness/runs/store/run_start.hpp"

#include <set>
#include <string>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/study/foreign/confine.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;

namespace {

/// The limits of cells that are active in this run.
std::vector<std::string> isolation_of(const std::vector<study::Scenario>& scenarios) {
  std::vector<std::string> active{"process groups", "death with parent", "adopted orphans", "RLIMIT_AS", "RLIMIT_CPU"};
  bool foreign = false, programs = false, libraries = false;
  for (const auto& scenario : scenarios)
    for (const auto& pipeline : scenario.pipelines)
      for (const auto& slot : pipeline.slots) {
        if (!slot.source) continue;
        foreign = true;
        (slot.source->program.empty() ? libraries : programs) |= scenario.limits.sandbox;
      }
  if (!foreign) {
    active.emplace_back("RLIMIT_CORE");
    return active;
  }
  for (std::string& name : study::active_confinement(programs, libraries)) active.push_back(std::move(name));
  return active;
}

/// "extract sk_ransac of python3 sk_ransac.py, version 1.2.1: RANSACRegressor of ...", each once, in alphabetical
/// order.
std::vector<std::string> foreign_modules_of(const std::vector<study::Scenario>& scenarios) {
  std::set<std::string> modules;
  for (const auto& scenario : scenarios)
    for (const auto& pipeline : scenario.pipelines)
      for (const auto& slot : pipeline.slots) {
        if (!slot.source) continue;
        const study::ForeignModule& module = slot.source->module;
        modules.insert(slot.kind + " " + module.info.name + " of " + slot.source->text() +
                       (module.version.empty() ? "" : ", version " + module.version) + ": " + module.info.summary);
      }
  return {modules.begin(), modules.end()};
}

}  // namespace

Manifest start_run(const RunTarget& target, const RunStart& start) {
  const fs::path& run = target.path();
  io::make_folders(run);
  Manifest manifest{"running", utc_now(), "", start.argv, {}, start.cells};
  for (const auto& scenario : start.scenarios) manifest.scenarios.push_back(scenario.name);
  if (!start.cells.empty()) manifest.isolation = isolation_of(start.scenarios);
  manifest.foreign_modules = foreign_modules_of(start.scenarios);
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

}  // namespace scanbench::runs
