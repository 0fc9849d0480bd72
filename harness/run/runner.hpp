// Runs scenarios: makes every recording once, runs every pipeline on it in a child process, and writes the results.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/run/run_options.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/run_scenarios.hpp"

namespace scanbench::harness {

/// What a run gets from outside, so that tests can replace it.
struct RunServices {
  std::function<Recording(const Scenario&, std::uint64_t seed, int threads)> recording;
  EffectiveText effective_yaml;
};

/// Must be called while the process has one thread (it forks). Cells that fail are rows of the result, not exceptions.
/// Throws ConfigError for options that select nothing, names that cannot be folders, an output folder that is not a run
/// or cannot be written, and scenarios from which no recording can be made; no file remains in these cases.
RunResult run_with(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services);

/// The same with the recordings of make_recording().
RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options);

}  // namespace scanbench::harness
