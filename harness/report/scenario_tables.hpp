// All tables of one scenario, in the order of a report.
#pragma once

#include <vector>

#include "harness/report/page_input.hpp"
#include "harness/report/results_table.hpp"
#include "harness/report/table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

/// How much is told about a scenario with published values.
enum class TableDetail {
  summary,    ///< the paper's tables and how far ours agree
  departures  ///< and every ordering that does not hold
};

/// The tables of a paper beside ours, if the scenario names them, and then what the paper does not print.
/// `cells` says how the scenario's cells ended: values are compared on those that every pipeline finished.
std::vector<Table> scenario_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                   const std::vector<CellLine>& cells, TableDetail detail);

}  // namespace scanbench::harness
