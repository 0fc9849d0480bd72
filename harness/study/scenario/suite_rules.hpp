// What a suite says of its run beside the scenarios: how its pipelines are ranked, and what may fail a comparison.
#pragma once

#include <optional>

#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/gate_spec.hpp"

namespace scanbench::study {

struct SuiteRules {
  std::optional<BenchmarkSpec> benchmark = {};
  GateSpec gates = {};
};

}  // namespace scanbench::study
