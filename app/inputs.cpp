// Loads scenario and suite files.
#include "app/inputs.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include "app/seed_list.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/suite.hpp"

namespace scanbench::app {

namespace fs = std::filesystem;
namespace {

/// Throws ConfigError for a folder, and, with the nearest file, if there is no such file.
void check_exists(const std::string& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw ConfigError(file + ": a folder, not a regular file; allowed: a scenario or suite file" +
                      (fs::exists(fs::path(file) / "effective.yaml", error)
                           ? ", like " + (fs::path(file) / "effective.yaml").string()
                           : ""));
  if (fs::exists(fs::symlink_status(file, error))) return;
  const std::string near = nearest_file(file);
  throw ConfigError(file + ": no such file" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace

void add_set_option(Verb& verb, std::vector<std::string>& sets) {
  verb.option("--set", sets, "KEY=VALUE: replaces a value of the file (dotted keys)").repeatable();
}

void add_jobs_option(Verb& verb, int& jobs, const std::string& help, const std::string& what) {
  verb.option("-j,--jobs", jobs, help).whole_number(what, 1, 1024).shows_default();
}

std::string nearest_file(const fs::path& path) {
  const bool bare = !path.has_parent_path();
  const std::string name = path.filename().string();
  if (const std::string near = nearest_name(name, io::names_in(bare ? "." : path.parent_path())); !near.empty())
    return (path.parent_path() / near).string();
  if (!bare) return "";
  for (const fs::path folder : {"scenarios", "scenarios/suites", "scenarios/logs", "out"}) {
    const auto names = io::names_in(folder);
    for (const std::string& candidate : {name, path.stem().string() + ".yaml"})
      if (const std::string near = nearest_name(candidate, names); !near.empty()) return (folder / near).string();
  }
  return "";
}

std::vector<study::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                         std::string* name, study::SuiteRules* rules) {
  std::vector<study::Scenario> scenarios;
  for (const auto& file : files) {
    check_exists(file);
    if (name != nullptr && name->empty()) *name = fs::path(file).stem().string();
    if (study::is_suite(file)) {
      study::Suite suite = study::load_suite(file, sets);
      for (auto& scenario : suite.scenarios) scenarios.push_back(std::move(scenario));
      if (rules != nullptr && files.size() == 1) *rules = suite.rules;
    } else {
      scenarios.push_back(study::load_scenario(file, sets));
      if (name != nullptr && files.size() == 1) *name = scenarios.back().name;
    }
  }
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (scenarios[i].name == scenarios[j].name)
        throw ConfigError("two scenarios are called '" + scenarios[i].name + "': " + scenarios[j].path.string() +
                          " and " + scenarios[i].path.string() + "; their results would share a folder");
  return scenarios;
}

void check_run_exists(const fs::path& run) {
  if (fs::is_directory(run)) return;
  if (fs::exists(run))
    throw ConfigError(run.string() + ": a file, not a run folder; `scanbench run` makes one, out/" +
                      run.stem().string() + " by default");
  const std::string near = nearest_file(run);
  const bool suggested = !near.empty() && fs::is_directory(near);
  throw ConfigError(run.string() + ": no such folder" + (suggested ? "; did you mean '" + near + "'?" : ""));
}

std::vector<study::Scenario> scenarios_for(const fs::path& run, const std::vector<std::string>& files) {
  check_run_exists(run);
  return files.empty() ? runs::load_run_scenarios(run) : load_inputs(files, {});
}

void give_seeds(std::vector<study::Scenario>& scenarios, const std::vector<std::string>& texts) {
  const std::vector<std::uint64_t> seeds = seeds_of(texts);
  if (seeds.empty()) return;
  for (auto& scenario : scenarios) scenario.seeds = seeds;
}

}  // namespace scanbench::app
