// Pipelines against each other, seed by seed, and the seeds in which an aligner did not place every scan.
#pragma once

#include <vector>

#include "harness/page/table.hpp"
#include "harness/report/comparable_rows.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

/// For scenarios of several seeds, if their poses are judged: every pair of pipelines, the mean difference of their
/// position errors and the mean ratio (geometric), paired over seeds, with 95 % intervals; and, where scans can be
/// placed or not, the seeds in which some were not, how far off the worst scan was, and what the aligner said.
/// `cells` gives what it said. No table for one seed or one pipeline.
std::vector<Table> paired_tables(const Scenario& scenario, const ComparableRows& results,
                                 const std::vector<CellLine>& cells);

}  // namespace scanbench::harness
