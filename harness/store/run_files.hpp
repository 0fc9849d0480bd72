// Begins and ends a run folder: its manifest, its scenarios and, if it is a benchmark, the specification of its page.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_target.hpp"

namespace scanbench::harness {

using EffectiveText = std::function<std::string(const Scenario&, const StoredInputs&)>;

/// What a run folder says of its run before any cell is made.
struct RunStart {
  const std::vector<Scenario>& scenarios;
  std::vector<CellKey> cells;     ///< of the run, in the order of summary.csv; empty for recordings alone
  std::vector<std::string> argv;  ///< the command line
  const std::optional<BenchmarkSpec>& benchmark;  ///< without one, benchmark.json of an earlier run is removed
  EffectiveText effective_yaml;
};

/// Writes the manifest, first of all files, with the state "running"; then the scenarios: one as scenario.yaml and
/// effective.yaml, several as files in scenarios/ and effective/. What is needed of the scenarios' own files is copied
/// to inputs/<scenario>/, so that reports, scores and figures need nothing outside the run folder: published values, a
/// set of lines, and the name and hash of a log. Throws ConfigError.
Manifest start_run(const RunTarget& target, const RunStart& start);

/// Writes the manifest with this state and the list of all files, and puts the run in its place. With `reports_follow`
/// the state in the file stays "running", until set_run_state().
void end_run(RunTarget& target, Manifest& manifest, const std::string& state, bool reports_follow = false);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest. Reads
/// nothing outside the folder.
std::vector<Scenario> load_run_scenarios(const std::filesystem::path& run);

/// Reads benchmark.json; nothing if the run is a plain one. Throws ConfigError.
std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

}  // namespace scanbench::harness
