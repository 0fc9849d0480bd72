// The tables of a paper in its own layout with our values beside the printed ones, and how far the two agree.
#pragma once

#include <vector>

#include "harness/analysis/agreement.hpp"
#include "harness/report/table.hpp"

namespace scanbench::harness {

/// One table for each of the paper's. Where it speaks of single lines: a row per line, and for each metric our value of
/// a method next to the printed one, the best of either side marked. Else a row per method, ours and the printed value
/// for each metric; a second table shows times as ratios, for they depend on the machine. Ours are medians over the
/// seeds, +- half the width of their 95 % interval.
std::vector<Table> paper_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

}  // namespace scanbench::harness
