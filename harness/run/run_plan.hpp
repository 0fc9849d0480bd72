// The cells of a run before any of them is made: which scenario, pipeline and seed, and the address of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/run/run_options.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario/trace_choice.hpp"
#include "harness/store/run_folder.hpp"

namespace scanbench::harness {

/// The cells of one scenario and seed, which share a recording.
struct PlannedGroup {
  const Scenario* scenario = nullptr;
  std::uint64_t seed = 0;
};

struct PlannedCell {
  CellKey key;
  std::string address;  ///< cell_address()
  const Scenario* scenario = nullptr;
  const PipelineSpec* pipeline = nullptr;
  TraceChoice trace;      ///< the rows that are kept
  std::size_t group = 0;  ///< index into RunPlan::groups
};

struct RunPlan {
  std::vector<PlannedGroup> groups;
  std::vector<PlannedCell> cells;  ///< in the order of summary.csv
};

/// All cells, whether selected or not; points into `scenarios`. Throws ConfigError for options that select nothing or
/// are invalid, and for names that cannot be folders or are given twice.
RunPlan plan_run(const std::vector<Scenario>& scenarios, const RunOptions& options);

/// True if `options.only` selects this cell.
bool selected(const RunOptions& options, const CellKey& key);

}  // namespace scanbench::harness
