// run --dry-run: what a run would do.
#pragma once

#include <vector>

#include "harness/runs/execute/run_options.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::app {

/// Prints cells, rays, bytes and seconds of every scenario and of all. Returns an exit code.
int print_forecast(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options, bool quiet);

}  // namespace scanbench::app
