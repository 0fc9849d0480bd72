// benchmark.json of a run folder: the run's reports are those of a benchmark.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/scenario/benchmark_spec.hpp"

namespace scanbench::harness {

std::string benchmark_json(const BenchmarkSpec& spec);

/// Reads benchmark.json of a run folder; nullopt if the run is no benchmark. Throws ConfigError if the file is damaged.
std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

}  // namespace scanbench::harness
