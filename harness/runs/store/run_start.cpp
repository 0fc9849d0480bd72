// The first and the last files of a run.
#include "harness/runs/store/run_start.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/study/foreign/confine.hpp"
#include "harness/study/foreign/sandbox_probe.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;

namespace {

/// A foreign module of a pipeline, and what the scenario says of it.
struct ForeignSlot {
  std::string kind;
  const study::ForeignSource* source;
  bool sandbox;

  bool is_program() const { return !source->program.empty(); }
  /// "extract sk_ransac of python3 sk_ransac.py, version 1.2.1"
  std::string text() const {
    const study::ForeignModule& module = source->module;
    return kind + " " + module.info.name + " of " + source->text() +
           (module.version.empty() ? "" : ", version " + module.version);
  }
};

std::vector<ForeignSlot> foreign_slots(const std::vector<study::Scenario>& scenarios) {
  std::vector<ForeignSlot> slots;
  for (const auto& scenario : scenarios)
    for (const auto& pipeline : scenario.pipelines)
      for (const auto& slot : pipeline.slots)
        if (slot.source) slots.push_back({slot.kind, &*slot.source, scenario.limits.sandbox});
  return slots;
}

/// Each text once, in alphabetical order.
template <class Text>
std::vector<std::string> texts_of(const std::vector<ForeignSlot>& slots, const Text& text) {
  std::set<std::string> texts;
  for (const ForeignSlot& slot : slots)
    if (std::string found = text(slot); !found.empty()) texts.insert(std::move(found));
  return {texts.begin(), texts.end()};
}

/// Writes which limits and sandboxes are active on this machine.
void note_isolation(Manifest& manifest, const std::vector<ForeignSlot>& slots) {
  manifest.isolation = {"process groups", "death with parent", "adopted orphans", "RLIMIT_AS", "RLIMIT_CPU"};
  if (slots.empty()) {
    manifest.isolation.emplace_back("RLIMIT_CORE");
    return;
  }
  const auto any = [&](auto which) { return std::ranges::any_of(slots, which); };
  const bool programs = any([](const ForeignSlot& s) { return s.is_program() && s.sandbox; });
  const bool libraries = any([](const ForeignSlot& s) { return !s.is_program() && s.sandbox; });
  for (std::string& name : study::active_confinement(programs, libraries))
    manifest.isolation.push_back(std::move(name));
  if (any([](const ForeignSlot& s) { return s.is_program(); }))
    manifest.sandbox["programs"] = study::sandbox_facts(programs);
  if (any([](const ForeignSlot& s) { return !s.is_program(); }))
    manifest.sandbox["libraries"] = {{"no network", libraries && study::can_leave_network()}};
  const study::SharedLimits shared = study::shared_limits();
  manifest.sandbox["cells"] = {{"one limit of memory for all processes", shared.memory},
                               {"one limit of the number of processes", shared.processes}};
}

void note_modules(Manifest& manifest, const std::vector<ForeignSlot>& slots) {
  manifest.foreign_modules =
      texts_of(slots, [](const ForeignSlot& s) { return s.text() + ": " + s.source->module.info.summary; });
  manifest.without_sandbox =
      texts_of(slots, [](const ForeignSlot& s) { return s.is_program() && s.sandbox ? "" : s.text(); });
}

}  // namespace

void note_foreign_modules(Manifest& manifest, const std::vector<study::Scenario>& scenarios) {
  note_modules(manifest, foreign_slots(scenarios));
}

Manifest start_run(const RunTarget& target, const RunStart& start) {
  const fs::path& run = target.path();
  io::make_folders(run);
  Manifest manifest{"running", utc_now(), "", start.argv, {}, start.cells};
  for (const auto& scenario : start.scenarios) manifest.scenarios.push_back(scenario.name);
  const std::vector<ForeignSlot> slots = foreign_slots(start.scenarios);
  if (!start.cells.empty()) note_isolation(manifest, slots);
  note_modules(manifest, slots);
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
