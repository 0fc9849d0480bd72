// The tables of a paper in its own layout with our values beside the printed ones, and how far the two agree.
#pragma once

#include <vector>

#include "harness/agreement.hpp"
#include "harness/table.hpp"

namespace scanbench::harness {

/// One table for each of the paper's. Where it speaks of single lines: a row per line, and for each metric our value of
/// a method next to the printed one, the best of either side marked. Else a row per method, ours and the printed value
/// for each metric; a second table shows times as ratios, for they depend on the machine. Ours are medians over the
/// seeds, +- half the width of their 95 % interval.
std::vector<Table> paper_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

/// How many of the paper's orderings hold, line by line and pair by pair of methods; on how many lines each method is
/// best; correlations. None if nothing of ours stands beside the printed values.
std::vector<Table> agreement_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

/// Every ordering of the paper that our medians do not show.
std::vector<Table> departure_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

}  // namespace scanbench::harness
