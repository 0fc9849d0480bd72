// The verbs plan, status, merge and submit, which run a suite on several machines, and a shard of `run --plan`.
#pragma once

#include <filesystem>
#include <string>

#include "app/options.hpp"

namespace scanbench::app {

void add_sweep(CommandLine& line);

/// `run --plan SWEEP --shard N`; returns the exit code.
int run_shard_of(const std::filesystem::path& sweep, const std::string& shard, int jobs, bool quiet);

}  // namespace scanbench::app
