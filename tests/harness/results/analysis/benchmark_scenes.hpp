// A benchmark of three extractors on two scenarios, x and y, and its page.
#pragma once

#include <vector>

#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/pages/benchmark_report.hpp"
#include "harness/results/pages/page_input.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/scenario_file.hpp"

namespace scanbench::results {

inline constexpr const char* kScene = R"(schema: 1
world: {segments: [[a, 0, 0, 4, 0], [b, 0, 4, 4, 4], [c, 0, 0, 0, 4]]}
sensor: {preset: ladar_2d30, sigma_m: 0.02}
trajectory: {kind: waypoints, points_m: {A: [1, 1], B: [3, 1]}, scans: 4}
pipelines:
  - {name: a, extract: {module: iepf, params: {threshold_m: 0.25}}}
  - {name: b, extract: {module: line_tracking}}
  - {name: c, extract: {module: sef}}
metrics: [segments, {name: efficiency, params: {matches: true}}, timing]
)";

inline std::vector<study::Scenario> two_scenarios() {
  std::vector<study::Scenario> scenarios{study::parse_scenario(kScene, "x.yaml"),
                                         study::parse_scenario(kScene, "y.yaml")};
  return scenarios;
}

inline const study::BenchmarkSpec kSpec{"what", "a", "x"};

/// x and y are the two levels of a factor.
inline study::BenchmarkSpec spec_with_levels() {
  study::BenchmarkSpec spec = kSpec;
  spec.levels = {{"light", "day", {"x"}}, {"light", "night", {"y"}}, {"place", "here", {"x", "y"}}};
  return spec;
}

inline Document page_of(ReportInput input, const study::BenchmarkSpec& spec) {
  input.ranking = rank_pipelines(input.scenarios, input.rows, spec);
  input.benchmark = spec;
  return benchmark_document(input);
}

}  // namespace scanbench::results
