// What a run is asked to do, how far it is, and how it ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/benchmark_spec.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/run_folder.hpp"

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

}  // namespace scanbench::harness
