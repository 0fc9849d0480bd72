// Begins and ends a run folder: its manifest, its scenarios and, if it is a benchmark, the specification of its page.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_target.hpp"

namespace scanbench::harness {

/// What a run folder says of its run before any cell is made.
struct RunStart {
  const std::vector<Scenario>& scenarios;
  std::vector<CellKey> cells;     ///< of the run, in the order of summary.csv; empty for recordings alone
  std::vector<std::string> argv;  ///< the command line
  const std::optional<BenchmarkSpec>& benchmark;  ///< without one, benchmark.json of an earlier run is removed
  std::function<std::string(const Scenario&)> effective_yaml;
};

/// Writes the manifest, first of all files, with the state "running"; then the scenarios: one as scenario.yaml and
/// effective.yaml, several as files in scenarios/ and effective/. Throws ConfigError.
Manifest start_run(const RunTarget& target, const RunStart& start);

/// Writes the manifest with this state and the list of all files, and puts the run in its place.
void end_run(RunTarget& target, Manifest& manifest, const std::string& state);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest.
std::vector<Scenario> load_run_scenarios(const std::filesystem::path& run);

/// Reads benchmark.json; nothing if the run is a plain one. Throws ConfigError.
std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

}  // namespace scanbench::harness
