// The scenarios that a run folder holds.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

using EffectiveText = std::function<std::string(const Scenario&, const StoredInputs&)>;

/// Writes one scenario as two files, several as files in scenarios/ and effective/; `effective_yaml` gives the text of
/// the latter. What is needed of the scenario's own files is copied to inputs/<scenario>/, so that reports, scores and
/// figures need nothing outside the run folder: published values, a set of lines, and the name and hash of a log.
/// Throws ConfigError.
void write_run_scenarios(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                         const EffectiveText& effective_yaml);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest. Reads nothing
/// outside the folder.
std::vector<Scenario> load_run_scenarios(const std::filesystem::path& run);

}  // namespace scanbench::harness
