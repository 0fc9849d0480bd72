// scenario.yaml and effective.yaml of a run folder; load_run_scenarios() of harness/runner.hpp reads them.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/runner.hpp"

namespace scanbench::harness {

/// One scenario as two files, several as files in scenarios/ and effective/. Throws ConfigError.
void write_run_scenarios(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                         const RunServices& services);

}  // namespace scanbench::harness
