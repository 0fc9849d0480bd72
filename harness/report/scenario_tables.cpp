// Collects the tables of a scenario: those of a paper first, then our own.
#include "harness/report/scenario_tables.hpp"

#include <algorithm>

#include "harness/analysis/agreement.hpp"
#include "harness/report/agreement_tables.hpp"
#include "harness/report/comparable_rows.hpp"
#include "harness/report/paired_tables.hpp"
#include "harness/report/paper_tables.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

std::vector<Table> scenario_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                   const std::vector<CellLine>& cells, TableDetail detail) {
  const ComparableRows results = comparable_rows(scenario, rows, cells);
  const Scenario shown = restricted(scenario, results);
  const auto columns = compare_with_paper(shown, results.rows);
  std::vector<std::string> printed;
  printed.reserve(columns.size());
  for (const auto& column : columns) printed.push_back(column.metric.metric);

  std::vector<std::string> captions = results.notes;
  for (const auto& note : results.line_notes)
    if (std::ranges::any_of(note.metrics, [&](const auto& m) { return std::ranges::count(printed, m) > 0; }))
      captions.push_back(note.text);
  std::vector<Table> tables = paper_tables(shown.name, columns);
  for (auto& table : tables)
    for (const auto& note : captions) table.caption += " " + note + ".";
  const auto append = [&](std::vector<Table> more) {
    for (auto& table : more) tables.push_back(std::move(table));
  };
  append(agreement_tables(shown.name, columns));
  if (detail == TableDetail::departures) append(departure_tables(shown.name, columns));
  append(result_tables(shown, results, printed));
  append(paired_tables(shown, results, cells));
  return tables;
}

std::optional<Table> scenario_overview(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                       const std::vector<CellLine>& cells) {
  const ComparableRows results = comparable_rows(scenario, rows, cells);
  return overview_table(restricted(scenario, results), results);
}

std::string scenario_answer(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                            const std::vector<CellLine>& cells, const Table& overview) {
  const std::string best = overview_sentence(overview);
  const std::string odometry = odometry_sentence(comparable_rows(scenario, rows, cells));
  return best + (best.empty() || odometry.empty() ? "" : " ") + odometry;
}

}  // namespace scanbench::harness
