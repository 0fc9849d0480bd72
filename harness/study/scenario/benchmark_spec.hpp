// The specification of a benchmark page: a suite's key `benchmark`, and benchmark.json in its run folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/yaml/gate.hpp"
#include "harness/study/scenario/benchmark_subject.hpp"

namespace scanbench::study {

struct Scenario;

/// The scenarios of a benchmark that share one level of a factor. The scenario file of a suite is the factor
/// "scenario".
struct BenchmarkLevel {
  std::string factor;                  ///< "noise"
  std::string level;                   ///< "5cm"
  std::vector<std::string> scenarios;  ///< names
};

struct BenchmarkSpec {
  std::string about;                        ///< the suite's description
  std::string baseline;                     ///< pipeline whose time is 1 in the ratios of times
  std::string example;                      ///< scenario whose scan is shown
  std::string of = "extract";               ///< slot whose modules are ranked
  std::vector<BenchmarkLevel> levels = {};  ///< of all factors, in the order of the suite; empty without factors

  const BenchmarkSubject& subject() const { return benchmark_subject(of); }
};

/// Reads the key `benchmark` of a suite of these scenarios: {of: extract, baseline: iepf, example: rooms-1cm}. The
/// defaults are extract and the first scenario; `about` and `levels` stay empty. Throws PlacedError for unknown names,
/// and unless all scenarios are simulated, share the same pipelines, and have the slot and the metrics that the subject
/// requires.
BenchmarkSpec read_benchmark(const io::YamlNode& node, const std::vector<Scenario>& scenarios);

/// What in a benchmark is not of these scenarios or keeps them from it, in words; empty if nothing does.
std::string benchmark_fault(const BenchmarkSpec& spec, const std::vector<Scenario>& scenarios);

/// The text of benchmark.json.
std::string benchmark_json(const BenchmarkSpec& spec);

}  // namespace scanbench::study
