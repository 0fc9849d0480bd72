// How far our results agree with a paper's.
#pragma once

#include <string>
#include <vector>

#include "harness/analysis/agreement.hpp"
#include "harness/report/table.hpp"

namespace scanbench::harness {

/// How many of the paper's orderings hold, line by line and pair by pair of methods; on how many lines each method is
/// best; correlations. None if nothing of ours stands beside the printed values.
std::vector<Table> agreement_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

/// Every ordering of the paper that our medians do not show.
std::vector<Table> departure_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

}  // namespace scanbench::harness
