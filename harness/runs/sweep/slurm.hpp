// Job scripts that run a sweep under Slurm: an array of its shards, then the merge.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/sweep/sweep_plan.hpp"

namespace scanbench::runs {

struct SlurmOptions {
  std::filesystem::path program;  ///< this one
  std::filesystem::path run;      ///< folder of the merged run
  int jobs = 1;                   ///< cells that run at once in a shard; as many processors are requested
};

struct SlurmScripts {
  std::string array;
  std::string merge;
};

/// The texts of both scripts. All paths in them are absolute.
SlurmScripts slurm_scripts(const SweepPlan& plan, const SlurmOptions& options);

/// Where the scripts and the logs of the jobs are.
std::filesystem::path slurm_folder(const std::filesystem::path& sweep);

/// A word that a shell reads as this text.
std::string shell_word(const std::string& text);

}  // namespace scanbench::runs
