// Published tables first, our own after them.
#include "harness/report/scenario_tables.hpp"

#include "harness/analysis/agreement.hpp"
#include "harness/report/agreement_tables.hpp"
#include "harness/report/paper_tables.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

std::vector<Table> scenario_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows, TableDetail detail) {
  const auto columns = compare_with_paper(scenario, rows);
  std::vector<std::string> printed;
  for (const auto& column : columns) printed.push_back(column.metric.metric);

  std::vector<Table> tables = paper_tables(scenario.name, columns);
  const auto append = [&](std::vector<Table> more) {
    for (auto& table : more) tables.push_back(std::move(table));
  };
  append(agreement_tables(scenario.name, columns));
  if (detail == TableDetail::departures) append(departure_tables(scenario.name, columns));
  append(result_tables(scenario, rows, printed));
  return tables;
}

}  // namespace scanbench::harness
