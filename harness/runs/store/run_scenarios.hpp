// The scenarios of a run folder, and the benchmark that a suite asks for.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::runs {

/// The text of an effective scenario whose input is copied into the run folder.
using EffectiveText = std::function<std::string(const study::Scenario&, const study::StoredInputs&)>;

/// Writes one scenario as scenario.yaml and effective.yaml, several as files in scenarios/ and effective/. What is
/// needed of the scenarios' own files is copied to inputs/<scenario>/, so that reports, scores and figures need nothing
/// outside the run folder: published values, a set of lines, the walls of a large world, and the name and hash of a
/// log. Throws ConfigError.
void write_run_scenarios(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                         const EffectiveText& effective_yaml);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest. Reads
/// nothing outside the folder.
std::vector<study::Scenario> load_run_scenarios(const std::filesystem::path& run);

/// The same for a folder without a manifest, like that of a sweep: its scenarios have these names.
std::vector<study::Scenario> load_run_scenarios(const std::filesystem::path& run,
                                                const std::vector<std::string>& names);

/// The files that write_run_scenarios() and write_suite_rules() have written, relative to the run folder. The scenarios
/// have these names.
std::vector<std::filesystem::path> scenario_files(const std::filesystem::path& run,
                                                  const std::vector<std::string>& names);

/// The effective settings of a run's scenarios (scenario/effective.hpp), by scenario. Throws ConfigError.
std::map<std::string, std::map<std::string, std::string>> load_run_settings(const std::filesystem::path& run);

/// Writes benchmark.json and gates.json, each if the suite has such rules; removes those of an earlier run.
void write_suite_rules(const std::filesystem::path& run, const study::SuiteRules& rules);

/// Reads benchmark.json; nothing if the run is a plain one. Throws ConfigError.
std::optional<study::BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

/// The same for the scenarios of the run. Throws ConfigError also if the benchmark is not one of these.
std::optional<study::BenchmarkSpec> load_benchmark(const std::filesystem::path& run,
                                                   const std::vector<study::Scenario>& scenarios);

/// Reads gates.json; the default gates if the run has none. Throws ConfigError.
study::GateSpec load_gates(const std::filesystem::path& run);

}  // namespace scanbench::runs
