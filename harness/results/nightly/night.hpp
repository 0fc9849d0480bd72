// A night: after the suite has run, its results are stored, judged and shown.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "harness/results/analysis/gates.hpp"
#include "harness/results/nightly/store.hpp"
#include "harness/runs/store/run_file.hpp"

namespace scanbench::results {

inline const runs::RunFile kComparisonJson("comparison.json");
inline const runs::RunFile kComparisonMarkdown("comparison.md");
inline const runs::RunFile kComparisonJunit("comparison.junit.xml");
inline const runs::RunFile kNightFile("night.json");

/// The suite of a run: the one that its night states (night.json), else the name of its folder. Throws ConfigError for
/// a damaged night.json.
std::string suite_of_run(const std::filesystem::path& run);

struct NightPlan {
  std::string suite;
  std::filesystem::path run;        ///< the run folder
  std::filesystem::path baselines;  ///< folder of all suites' baselines
  std::string baseline;             ///< number of one of them; empty: the newest
  Gates gates;
  std::size_t reused = 0;  ///< cells of the run that were not run again
};

/// Throws ConfigError if the plan names a baseline that is not there or cannot be read.
void check_plan(const NightPlan& plan);

struct NightOutcome {
  std::string sentence;
  std::filesystem::path page;
  int exit_code = 0;  ///< 0 good, 1 a gate is worse or a cell failed, 2 nothing to compare, 4 incomplete, 5 both
};

/// Stores the run as a night of its suite, compares it with the baseline, else with the last good night, and writes
/// nightly.html, comparison.json, comparison.md and comparison.junit.xml into the run folder. Throws ConfigError.
NightOutcome close_night(const NightPlan& plan, Store store);

}  // namespace scanbench::results
