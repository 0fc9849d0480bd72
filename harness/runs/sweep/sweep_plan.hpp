// The plan of a sweep: a suite whose cells are divided into shards, which any number of machines run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::runs {

/// Batch systems refuse longer arrays of jobs.
inline constexpr int kMostShards = 1000;
/// Shards of a sweep unless the user says otherwise.
inline constexpr int kShardsUnlessGiven = 100;

struct SweepCell {
  CellKey key;
  std::string address;  ///< cell_address()
  int shard = 0;        ///< 1, 2, ...; 0: it was committed before the sweep was planned
};

struct SweepPlan {
  std::filesystem::path folder;
  std::string name;                    ///< of the suite
  std::vector<std::string> scenarios;  ///< their names
  int shards = 0;
  bool journal = false;          ///< cells keep all rows of their traces
  std::vector<SweepCell> cells;  ///< in the order of summary.csv
  std::string code;              ///< code_version() of the program that planned
  std::string program;           ///< version_text() of that program
};

struct SweepOptions {
  std::filesystem::path out;
  std::string name;
  int shards = kShardsUnlessGiven;  ///< at most; a recording is never divided
  bool journal = false;
  std::vector<std::string> argv = {};
  study::SuiteRules rules = {};
};

/// Writes the folder of a sweep: the effective scenarios with copies of their files as in a run folder, cells.csv and
/// sweep.json. Cells that shards of an earlier plan in the folder have committed, undamaged, get no shard. Throws
/// ConfigError for a folder that is not a sweep, for shards outside 1 .. 1000, and what plan_run() throws.
SweepPlan plan_sweep(const std::vector<study::Scenario>& scenarios, const SweepOptions& options);

/// Loads a plan. Throws ConfigError if the folder is not a sweep or a file of the plan is not as it was written.
SweepPlan load_sweep(const std::filesystem::path& folder);

/// Throws ConfigError if another program than this one made the plan.
void require_this_program(const SweepPlan& plan);

/// The scenarios of a plan. Throws ConfigError if a log has other bytes than when it was planned.
std::vector<study::Scenario> sweep_scenarios(const SweepPlan& plan);

}  // namespace scanbench::runs
