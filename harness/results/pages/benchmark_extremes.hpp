// Parts of a benchmark's page beside the ranking: accuracy against time, and where each pipeline does worst.
#pragma once

#include "harness/results/document/document.hpp"
#include "harness/results/pages/page_input.hpp"

namespace scanbench::results {

/// A chart of the rank's metric against the time of the benchmark, over all conditions. Empty if no time is known.
Blocks accuracy_blocks(const ReportInput& input);

/// The cell of each pipeline with the worst value of the rank's metric, with links to its files; of extractors also
/// the worst scan of that cell. Empty without values. Throws ConfigError for damaged files.
Blocks worst_blocks(const ReportInput& input);

}  // namespace scanbench::results
