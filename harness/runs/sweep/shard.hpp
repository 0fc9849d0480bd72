// Runs one shard of a sweep and commits what it has made.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/runs/execute/execution.hpp"
#include "harness/runs/execute/run_options.hpp"

namespace scanbench::runs {

struct ShardOptions {
  int shard = 0;
  int jobs = 1;  ///< children at once
  std::function<void(const RunProgress&)> progress = {};
  MakeRecording recording = {};  ///< make_recording() unless given, so that tests can replace it
};

struct ShardResult {
  std::size_t planned = 0;          ///< cells of the shard
  std::size_t earlier = 0;          ///< of them, those that an earlier attempt has committed
  std::vector<CellResult> cells;    ///< the others, in the order of the plan
  std::filesystem::path committed;  ///< empty if there was nothing to commit
  bool interrupted = false;         ///< not by SIGTERM
  /// 0 all cells ok; 3 some are not; 4 some are missing; 130 interrupted.
  int exit_code() const;
};

/// Runs the cells of a shard that no undamaged commit of this shard has. After an interrupt, cells that run get 20 s to
/// end; what has ended is committed. Must be called while the process has one thread. Throws ConfigError for a number
/// that the plan does not have, for what load_sweep() refuses, and for another program than the one that planned.
ShardResult run_shard(const std::filesystem::path& sweep, const ShardOptions& options);

/// The number of the shard: the text of `--shard` or, if that is empty, of the first of the environment's variables
/// SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX (which counts from 0) and PARALLEL_SEQ that is set. Throws ConfigError.
int shard_number(const std::string& option);

}  // namespace scanbench::runs
