// Scenario files in a run folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// Writes one scenario as two files, several as files in scenarios/ and effective/; `effective_yaml` gives the text of
/// the latter. Throws ConfigError.
void write_run_scenarios(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                         const std::function<std::string(const Scenario&)>& effective_yaml);

/// The scenarios of a run folder, from effective.yaml or effective/*.yaml, in the order of its manifest.
std::vector<Scenario> load_run_scenarios(const std::filesystem::path& run);

}  // namespace scanbench::harness
