// Makes an ordinary run folder from the committed shards of a sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"

namespace scanbench::runs {

/// Cells that keep a sweep from being merged.
struct MissingCells {
  std::size_t count = 0;
  std::vector<int> shards;         ///< that must run again, ascending
  std::size_t lost = 0;            ///< cells without a shard: the sweep must be planned again
  std::vector<std::string> notes;  ///< damaged commits
};

/// How a run folder holds the files of its cells.
enum class CellForm {
  automatic,  ///< as files up to kMostCellsAsFiles cells, else as archives
  files,      ///< cells/ and recordings/, as any run
  archives,   ///< the archives of the shards, and tables of what is in them (store/archived_run.hpp)
};
/// 13 files per cell and recording make 130 000 files of 10^4 cells; a file system needs a minute for them.
inline constexpr std::size_t kMostCellsAsFiles = 1000;

struct MergedSweep {
  std::optional<MissingCells> missing;  ///< then nothing has been written
  RunResult run;
};

/// Checks the archives of the shards and makes the run folder `options.out` of them; of the options, `argv` and
/// `finish` count as well. As files, the run has the bytes of run() with the same scenarios, but for times. As
/// archives, these are hard links or copies, and the cells of each scenario's first seed, which figures show, are files
/// too if they are at most kMostCellsAsFiles. After a failure nothing remains. Throws ConfigError if another program
/// planned the sweep, if two commits of a cell or recording differ in what must be equal (the message names the file),
/// and what RunTarget throws.
MergedSweep merge_sweep(const SweepPlan& plan, const RunOptions& options, CellForm form = CellForm::automatic);

}  // namespace scanbench::runs
