// Options, progress and result of a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::runs {

/// Result of one cell.
struct CellResult {
  CellKey key;
  bool done = false;    ///< its folder is in the run; false: missing
  bool reused = false;  ///< taken from an earlier run with the same input and program
  CellRecord record;
};

struct RunProgress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string what;                  ///< "recording hallway/1" or "hallway/iepf/1"
  const CellResult* cell = nullptr;  ///< the cell that has just ended, if one has
};

struct RunResult {
  std::filesystem::path out;      ///< RunOptions::out without "." and ".."
  std::vector<CellResult> cells;  ///< selected ones, in the order of summary.csv
  bool interrupted = false;
  bool old_run_kept = false;  ///< the earlier run in the folder stays, because this one is incomplete
  /// 0 all cells ok; 3 some are not; 4 some are missing; 130 interrupted.
  int exit_code() const;
};

struct RunOptions {
  std::filesystem::path out;
  int jobs = 1;  ///< children at once
  /// Names of scenarios or pipelines, or "scenario/pipeline"; empty: all. An earlier run in the folder keeps its other
  /// cells.
  std::vector<std::string> only = {};
  bool resume = false;
  bool journal = false;                ///< keep all trace rows of every cell; else those that the figures draw
  std::vector<std::string> argv = {};  ///< for the manifest
  study::SuiteRules rules = {};
  std::function<void(const RunProgress&)> progress = {};
  /// Draws figures and writes reports. Called after the run has reached its folder, which is still locked.
  std::function<void(const RunResult&)> finish = {};
};

}  // namespace scanbench::runs
