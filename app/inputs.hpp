// The scenarios and seeds that the command line names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::app {

/// Scenarios of scenario and suite files, in order; `name` receives the first file's name without extension,
/// `benchmark` the specification of a suite that is the only file.
std::vector<harness::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                           std::string* name = nullptr,
                                           std::optional<harness::BenchmarkSpec>* benchmark = nullptr);

/// Replaces the scenarios' seeds by those of `--seed`, if there are any. Throws ConfigError for a seed that a scenario
/// file could not have, and for one that is given twice.
void give_seeds(std::vector<harness::Scenario>& scenarios, const std::vector<std::string>& texts);

}  // namespace scanbench::app
