// Tables of the agreement of our results with a paper's.
#pragma once

#include <string>
#include <vector>

#include "harness/results/analysis/agreement.hpp"
#include "harness/results/document/table.hpp"

namespace scanbench::results {

/// Tables of the paper's orderings that hold, by line and by pair of methods, of the number of lines on which each
/// method is best, and of correlations. Empty if we have no values for the printed ones.
std::vector<Table> agreement_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

/// Every ordering of the paper that our medians do not show.
std::vector<Table> departure_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns);

}  // namespace scanbench::results
