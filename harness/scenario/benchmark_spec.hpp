// What a benchmark is asked to show: a suite's key `benchmark`, and benchmark.json in its run folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "harness/yaml/gate.hpp"

namespace scanbench::harness {

struct BenchmarkSpec {
  std::string about;     ///< the suite's
  std::string baseline;  ///< pipeline that times are given as ratios to
  std::string example;   ///< scenario of which one scan is shown
};

/// Reads the key `benchmark` of a suite of these scenarios: {baseline: iepf, example: rooms-1cm}. The example is the
/// first scenario unless it is named; `about` stays empty. Throws PlacedError for unknown names, and if the scenarios
/// are not simulated, have not all the same pipelines, or not the metrics segments, efficiency (with matches: true) and
/// timing.
BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios);

std::string benchmark_json(const BenchmarkSpec& spec);
/// Of a run folder; nothing if the run is no benchmark. Throws ConfigError if the file is damaged.
std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

}  // namespace scanbench::harness
