// Parts of a benchmark's page beside the ranking: accuracy against time, and where each pipeline does worst.
#pragma once

#include <vector>

#include "harness/results/document/document.hpp"
#include "harness/results/figures/worst_scans.hpp"
#include "harness/results/pages/page_input.hpp"

namespace scanbench::results {

/// A chart of the rank's metric against the time of the benchmark, over all conditions. Empty if no time is known.
Blocks accuracy_blocks(const ReportInput& input);

/// The cell of each pipeline with the worst value of the rank's metric, with links to its files, and `input.worst`.
/// Empty without values.
Blocks worst_blocks(const ReportInput& input);

/// The worst scan of each of these cells, read from the run; empty if pages of this benchmark show no scan. Throws
/// ConfigError for damaged files.
std::vector<PipelineWorst> benchmark_worst_scans(const ReportInput& input);

}  // namespace scanbench::results
