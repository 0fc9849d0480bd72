// The ranking of a benchmark as a table.
#pragma once

#include <vector>

#include "harness/analysis/benchmark.hpp"
#include "harness/page/table.hpp"
#include "harness/scenario/benchmark_spec.hpp"

namespace scanbench::harness {

Table ranking_table(const std::vector<RankedPipeline>& ranking, const BenchmarkSpec& spec);

}  // namespace scanbench::harness
