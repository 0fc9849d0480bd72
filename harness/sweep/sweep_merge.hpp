// Makes an ordinary run folder from the committed shards of a sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/run/run_options.hpp"
#include "harness/sweep/sweep_plan.hpp"

namespace scanbench::harness {

/// Cells that keep a sweep from being merged.
struct MissingCells {
  std::size_t count = 0;
  std::vector<int> shards;         ///< that must run again, ascending
  std::size_t lost = 0;            ///< cells without a shard: the sweep must be planned again
  std::vector<std::string> notes;  ///< damaged commits
};

struct MergeResult {
  std::optional<MissingCells> missing;  ///< then nothing has been written
  RunResult run;
};

/// Reads and checks all files of the committed cells and makes links to them, or copies where the file system has no
/// links, in the run folder `options.out`; of the options, `argv` and `finish` count as well. The run has the bytes of
/// run() with the same scenarios, but for times. Throws ConfigError if another program planned the sweep, if two
/// commits of a cell or recording differ in what must be equal (the message names the file), and what RunTarget throws.
MergeResult merge_sweep(const SweepPlan& plan, const RunOptions& options);

}  // namespace scanbench::harness
