// What decides the rank of a benchmark, at each level of its factors: which pipeline is best under which condition.
#pragma once

#include <string>
#include <vector>

#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/document/table.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"

namespace scanbench::results {

/// One row per pipeline, one column per level, grouped by factors; the best of each column is marked. `names` are the
/// pipelines that `results` are of.
Table level_table(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                  const study::BenchmarkSpec& spec);

/// "optimal has the best F1 at every level, except ...", and where the seeds do not separate the best two. Empty
/// without results.
std::string best_by_level_text(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                               const study::BenchmarkSpec& spec);

}  // namespace scanbench::results
