// The cells of a run before any of them is made: which scenario, pipeline and seed, and the address of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::runs {

/// The cells of one scenario and seed, which share a recording.
struct PlannedGroup {
  const study::Scenario* scenario = nullptr;
  std::uint64_t seed = 0;
};

/// What the cells of one pipeline of one scenario share.
struct PlannedWork {
  const study::Scenario* scenario = nullptr;
  const study::PipelineSpec* pipeline = nullptr;
  std::string input;          ///< input_address()
  std::string address;        ///< work_address()
  study::TraceChoice shown;   ///< rows that are kept for the seed that figures show
  study::TraceChoice others;  ///< for all other seeds
};

/// A plan may have 10^5 cells, and the memory that holds it is copied for each child process, so a cell has indices
/// only.
struct PlannedCell {
  std::uint32_t work = 0;   ///< index into RunPlan::works
  std::uint32_t group = 0;  ///< index into RunPlan::groups
  bool shown = false;       ///< figures show it
};

struct RunPlan {
  std::vector<PlannedGroup> groups;
  std::vector<PlannedWork> works;
  std::vector<PlannedCell> cells;  ///< in the order of summary.csv

  CellKey key(const PlannedCell& cell) const;
  std::string address(const PlannedCell& cell) const;  ///< cell_address()
  const study::TraceChoice& trace(const PlannedCell& cell) const;
};

/// All cells, whether selected or not; points into `scenarios`. Throws ConfigError for options that select nothing or
/// are invalid, and for names that cannot be folders or are given twice.
RunPlan plan_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options);

/// True if `options.only` selects this cell.
bool selected(const RunOptions& options, const CellKey& key);

}  // namespace scanbench::runs
