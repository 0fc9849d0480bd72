// Begins and ends a run folder.
#pragma once

#include <string>
#include <vector>

#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_target.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::runs {

/// What a run folder says of its run before any cell is made.
struct RunStart {
  const std::vector<study::Scenario>& scenarios;
  std::vector<CellKey> cells;     ///< of the run, in the order of summary.csv; empty for recordings alone
  std::vector<std::string> argv;  ///< the command line
  study::SuiteRules rules;        ///< benchmark.json and gates.json of an earlier run are replaced or removed
  EffectiveText effective_yaml;
};

/// Writes the manifest, first of all files, with the state "running"; then the scenarios, as
/// write_run_scenarios() does. Throws ConfigError.
Manifest start_run(const RunTarget& target, const RunStart& start);

/// Sets `foreign_modules` and `without_sandbox`, of a run whose cells were made elsewhere.
void note_foreign_modules(Manifest& manifest, const std::vector<study::Scenario>& scenarios);

/// Writes the manifest with this state and the list of all files, and puts the run in its place. With `reports_follow`
/// the state in the file stays "running", until set_run_state().
void end_run(RunTarget& target, Manifest& manifest, const std::string& state, bool reports_follow = false);

}  // namespace scanbench::runs
