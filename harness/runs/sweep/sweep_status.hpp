// How far a sweep is: which cells are committed, and which shards must run again.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "harness/runs/sweep/sweep_plan.hpp"

namespace scanbench::runs {

struct SweepStatus {
  std::size_t cells = 0;
  std::size_t ok = 0;
  std::size_t failed = 0;           ///< committed with another status
  std::size_t missing = 0;          ///< not committed
  std::vector<int> missing_shards;  ///< with missing cells, ascending
  /// Missing cells without a shard, because they were committed when the sweep was planned: it must be planned again.
  std::size_t lost = 0;
  std::vector<std::pair<std::string, std::string>> damaged;  ///< folders of shards, and what is wrong
  std::size_t unfinished = 0;                                ///< folders of shards that run or were killed
};

/// From the tables of the commits. The files of the cells are not read.
SweepStatus sweep_status(const SweepPlan& plan);

/// Ascending numbers as `sbatch --array=` takes them: "1-3,7".
std::string array_text(const std::vector<int>& numbers);

}  // namespace scanbench::runs
