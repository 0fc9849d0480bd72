// Runs scenarios: makes every recording once, runs every pipeline on it in a child process, and writes the results.
#pragma once

#include <string>
#include <vector>

#include "harness/runs/execute/execution.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::runs {

/// What a run gets from outside, so that tests can replace it.
struct RunServices {
  MakeRecording recording;
  EffectiveText effective_yaml;
};

/// Must be called while the process has one thread (it forks). Cells that fail are rows of the result, not exceptions.
/// Throws ConfigError for options that select nothing, names that cannot be folders, an output folder that is not a run
/// or cannot be written, and scenarios from which no recording can be made; no file remains in these cases.
RunResult run_with(const std::vector<study::Scenario>& scenarios, const RunOptions& options,
                   const RunServices& services);

/// Lets `options.finish` draw figures and write reports for a run that is in its folder and whose state will be
/// `state`. A run is complete when they exist; killed before, it is still running, as any other run that was killed.
void finish_run(const RunResult& result, const std::string& state, const RunOptions& options);

/// run_with() with the recordings of make_recording().
RunResult run(const std::vector<study::Scenario>& scenarios, const RunOptions& options);

}  // namespace scanbench::runs
