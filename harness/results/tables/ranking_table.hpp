// The ranking of a benchmark as a table.
#pragma once

#include <vector>

#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/document/table.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"

namespace scanbench::results {

Table ranking_table(const std::vector<RankedPipeline>& ranking, const study::BenchmarkSpec& spec);

}  // namespace scanbench::results
