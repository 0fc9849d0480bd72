// Runs scenarios: recordings made once, every pipeline on every recording in a child process, results as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/benchmark.hpp"
#include "harness/cell_files.hpp"
#include "harness/run_folder.hpp"
#include "harness/scenario.hpp"

namespace scanbench::harness {

/// What became of one cell.
struct CellResult {
  CellKey key;
  bool done = false;    ///< its folder stands in the run; false: missing
  bool reused = false;  ///< resumed: it stood there already, made of the same input by the same program
  CellRecord record;
};

struct RunProgress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string what;                  ///< "recording hallway/1" or "hallway/iepf/1"
  const CellResult* cell = nullptr;  ///< the cell that has just ended, if one has
};

struct RunOptions {
  std::filesystem::path out;
  int jobs = 1;                        ///< children at once
  std::vector<std::string> only = {};  ///< names of scenarios or pipelines, or "scenario/pipeline"; empty: all
  bool resume = false;
  bool journal = false;                ///< the whole trace.csv in every cell; else the rows that the figures draw from
  std::vector<std::string> argv = {};  ///< for the manifest
  std::optional<BenchmarkSpec> benchmark = {};
  std::function<void(const RunProgress&)> progress = {};
};

struct RunResult {
  std::filesystem::path out;
  std::vector<CellResult> cells;  ///< selected ones, in the order of summary.csv
  bool interrupted = false;
  /// 0 all cells ok; 3 some are not; 4 some are missing; 130 interrupted.
  int exit_code() const;
};

/// How a run gets at what it does not do itself; tests put their own in.
struct RunServices {
  std::function<Recording(const Scenario&, std::uint64_t seed, int threads)> recording;
  std::function<std::string(const Scenario&)> effective_yaml;
};

/// Must be called while the process has one thread (it forks). Cells that fail are rows of the result, not exceptions.
/// Throws ConfigError for options that select nothing, names that cannot be folders, an output folder that is not ours
/// or cannot be written, and if no recording can be made because the scenarios are wrong: nothing is left behind then.
RunResult run_with(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services);

/// With simulation and logs (harness/scenario.hpp).
RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest.
std::vector<Scenario> load_run_scenarios(const std::filesystem::path& run);

}  // namespace scanbench::harness
