// The scenarios and seeds that the command line names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "harness/scenario/suite_rules.hpp"

namespace scanbench::app {

/// The path that a misspelt one probably means: the nearest name in the same folder; for a bare name like `abcdef`,
/// also a file below scenarios/ or a folder of out/ of that name. Empty if nothing is near.
std::string nearest_file(const std::filesystem::path& path);

/// Scenarios of scenario and suite files, in order; `name` receives the first file's name without extension,
/// `rules` those of a suite that is the only file.
std::vector<harness::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                           std::string* name = nullptr, harness::SuiteRules* rules = nullptr);

/// Throws ConfigError, with the nearest name, for a folder that does not exist.
void check_run_exists(const std::filesystem::path& run);

/// The scenarios of a run, or those of files that replace them: to score with other metrics, to draw other figures.
std::vector<harness::Scenario> scenarios_for(const std::filesystem::path& run, const std::vector<std::string>& files);

/// Replaces the scenarios' seeds by those of `--seed`, if there are any. Throws ConfigError for a seed that a scenario
/// file could not have, and for one that is given twice.
void give_seeds(std::vector<harness::Scenario>& scenarios, const std::vector<std::string>& texts);

}  // namespace scanbench::app
