// What a benchmark found: which pipelines lead, and under which condition which of them.
#pragma once

#include <string>
#include <vector>

#include "harness/results/analysis/benchmark.hpp"

namespace scanbench::results {

/// Of fewer seeds, one of two equal methods is ahead on all of them more often than not.
constexpr int kFewestSeedsToSeparate = 3;

struct BenchmarkFinding {
  /// The first in rank, then those of shared_best() in rank order. Empty if no pipeline has a result in every cell, and
  /// for fewer than kFewestSeedsToSeparate seeds.
  std::vector<std::string> leaders;
  /// The factor that changes most which pipeline leads; empty if none changes it. A factor changes it if one pipeline
  /// leads at a level and is separated from the leaders of another, and vice versa. Among such factors, the one with
  /// the largest interaction with the pipelines that lead somewhere: the mean square of what their means over the seeds
  /// differ from the sum of an effect of the pipeline and one of the level (two-way analysis of variance).
  std::string factor;
  std::vector<LevelResult> levels;  ///< of this factor; if it is empty, of all factors
};

/// `ranking` is that of the same scenarios and rows; `levels` of the result are of the pipelines in its order.
BenchmarkFinding find_leaders(const std::vector<study::Scenario>& scenarios, const std::vector<runs::SummaryRow>& rows,
                              const study::BenchmarkSpec& spec, const std::vector<RankedPipeline>& ranking);

}  // namespace scanbench::results
