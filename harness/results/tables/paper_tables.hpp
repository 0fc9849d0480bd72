// The tables of a paper in its own layout, with our values beside the printed ones.
#pragma once

#include <vector>

#include "harness/results/analysis/agreement.hpp"
#include "harness/results/document/table.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::results {

/// One table for each table of the paper. If the paper prints single lines, the table has a row per line and, for each
/// metric, our value of a method beside the printed one, with the best of either side marked. Else it has a row per
/// method with our value and the printed one for each metric; a second table then shows times as ratios, because times
/// depend on the machine. Our values are medians over the seeds, +- half the width of their 95 % interval. `rows`: of
/// the run; by their metric `missed`, a pipeline that misses a line in most scans is not called best on it.
std::vector<Table> paper_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns,
                                const std::vector<runs::SummaryRow>& rows = {});

}  // namespace scanbench::results
