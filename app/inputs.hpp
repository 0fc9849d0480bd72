// The scenarios and seeds that the command line names, and the options that several verbs have for them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::app {

/// --set: the overrides that load_inputs() applies.
void add_set_option(Verb& verb, std::vector<std::string>& sets);

/// --jobs: how many of them at the same time; `help` says of what.
void add_jobs_option(Verb& verb, int& jobs, const std::string& help, const std::string& what = "number of cells");

/// The path that a misspelt one probably means: the nearest name in the same folder; for a bare name like `abcdef`,
/// also a file below scenarios/ or a folder of out/ of that name. Empty if nothing is near.
std::string nearest_file(const std::filesystem::path& path);

/// Scenarios of scenario and suite files, in order; `name` receives the first file's name without extension,
/// `rules` those of a suite that is the only file.
std::vector<study::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                         std::string* name = nullptr, study::SuiteRules* rules = nullptr);

/// Throws ConfigError, with the nearest name, for a folder that does not exist.
void check_run_exists(const std::filesystem::path& run);

/// The scenarios of a run, or those of files that replace them: to score with other metrics, to draw other figures.
std::vector<study::Scenario> scenarios_for(const std::filesystem::path& run, const std::vector<std::string>& files);

/// Replaces the scenarios' seeds by those of `--seed`, if there are any. Throws ConfigError as seeds_of() does.
void give_seeds(std::vector<study::Scenario>& scenarios, const std::vector<std::string>& texts);

}  // namespace scanbench::app
