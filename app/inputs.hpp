// The scenarios and seeds that the command line names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::app {

/// The path that a misspelt one probably means: the nearest name in the same folder; for a bare name like `abcdef`,
/// also a file below scenarios/ or a folder of out/ of that name. Empty if nothing is near.
std::string nearest_file(const std::filesystem::path& path);

/// Scenarios of scenario and suite files, in order; `name` receives the first file's name without ending, `benchmark`
/// what a suite that stands alone ranks.
std::vector<harness::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                           std::string* name = nullptr,
                                           std::optional<harness::BenchmarkSpec>* benchmark = nullptr);

/// Seeds of `--seed` in place of the scenarios' own, if there are any. Throws ConfigError for anything but whole
/// numbers that a scenario file may have, and for one that is given twice.
void give_seeds(std::vector<harness::Scenario>& scenarios, const std::vector<std::string>& texts);

}  // namespace scanbench::app
