// Runs scenarios: recordings made once, every pipeline on every recording in a child process, results as files.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/run/run_options.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/run_files.hpp"

namespace scanbench::harness {

/// What a run does not do itself; tests replace it.
struct RunServices {
  std::function<Recording(const Scenario&, std::uint64_t seed, int threads)> recording;
  EffectiveText effective_yaml;
};

/// Must be called while the process has one thread (it forks). Cells that fail are rows of the result, not exceptions.
/// Throws ConfigError for options that select nothing, names that cannot be folders, an output folder that is not ours
/// or cannot be written, and if no recording can be made because the scenarios are wrong: nothing remains then.
RunResult run_with(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services);

/// With simulation and logs (harness/run/make_recording.hpp).
RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options);

}  // namespace scanbench::harness
