// Pipelines against each other, seed by seed, and the seeds in which an aligner did not place every scan.
#pragma once

#include <vector>

#include "harness/results/document/table.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// For scenarios of several seeds, if their poses are judged: every pair of pipelines, the mean difference of their
/// position errors and the mean ratio (geometric), paired over seeds, with 95 % intervals; and, where scans can be
/// placed or not, the seeds in which some were not, how far off the worst scan was, and what the aligner said.
/// `cells` gives what it said. No table for one seed or one pipeline.
std::vector<Table> paired_tables(const study::Scenario& scenario, const ComparableRows& results,
                                 const std::vector<CellLine>& cells);

}  // namespace scanbench::results
