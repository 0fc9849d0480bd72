// The specification of a benchmark page: a suite's key `benchmark`, and benchmark.json in its run folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "harness/yaml/gate.hpp"

namespace scanbench::harness {

struct BenchmarkSpec {
  std::string about;     ///< the suite's description
  std::string baseline;  ///< pipeline whose time is 1 in the ratios of times
  std::string example;   ///< scenario whose scan is shown
};

/// Reads the key `benchmark` of a suite of these scenarios: {baseline: iepf, example: rooms-1cm}. The default example
/// is the first scenario; `about` stays empty. Throws PlacedError for unknown names, and unless all scenarios are
/// simulated, share the same pipelines, and have the metrics segments, efficiency (with matches: true) and timing.
BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios);

/// The text of benchmark.json.
std::string benchmark_json(const BenchmarkSpec& spec);

}  // namespace scanbench::harness
