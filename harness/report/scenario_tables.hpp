// All tables of one scenario, in the order of a report.
#pragma once

#include <optional>
#include <vector>

#include "harness/page/table.hpp"
#include "harness/report/page_input.hpp"
#include "harness/report/results_table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

/// How much is shown for a scenario with published values.
enum class TableDetail {
  summary,    ///< the paper's tables and their agreement with ours
  departures  ///< and every ordering that does not hold
};

/// The tables of a paper with our values, if the scenario names one, then tables of the other metrics. `cells` has the
/// status of the scenario's cells; values are compared on the seeds that every pipeline finished.
std::vector<Table> scenario_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                   const std::vector<CellLine>& cells, TableDetail detail);

/// overview_table() of the values on which the pipelines are compared.
std::optional<Table> scenario_overview(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                       const std::vector<CellLine>& cells);

/// What its overview says, in sentences: the best pipeline, and which are no better than the odometry.
std::string scenario_answer(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                            const std::vector<CellLine>& cells, const Table& overview);

}  // namespace scanbench::harness
