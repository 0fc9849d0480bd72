// The results of one scenario: all of its tables, in the order of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results/document/table.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// The results of one scenario as pages and the terminal show them.
struct ScenarioResults {
  std::optional<Table> overview{};  ///< overview_table() of the values on which the pipelines are compared
  std::string answer{};  ///< what it says, in sentences: the best pipeline, and which are no better than the odometry
  std::vector<Table> tables{};
};

/// The tables of a paper with our values, if the scenario names one, then tables of the other metrics. `cells` has the
/// status of the scenario's cells; values are compared on the seeds that every pipeline finished.
ScenarioResults scenario_results(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows,
                                 const std::vector<CellLine>& cells);

}  // namespace scanbench::results
