// Collects the results of a scenario: the tables of a paper first, then our own.
#include "harness/results/tables/scenario_tables.hpp"

#include <algorithm>
#include <utility>

#include "harness/results/analysis/agreement.hpp"
#include "harness/results/tables/agreement_tables.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/results/tables/paired_tables.hpp"
#include "harness/results/tables/paper_tables.hpp"
#include "harness/results/tables/results_table.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::results {

namespace {

/// The tables of a paper with our values, with the notes that concern them in the captions.
std::vector<Table> annotated_paper_tables(const std::string& scenario, const ComparableRows& results,
                                          const std::vector<ComparedColumn>& columns) {
  std::vector<std::string> captions = results.notes;
  const auto is_printed = [&](const std::string& metric) {
    return std::ranges::any_of(columns, [&](const auto& column) { return column.metric.metric == metric; });
  };
  for (const auto& note : results.line_notes)
    if (std::ranges::any_of(note.metrics, is_printed)) captions.push_back(note.text);
  std::vector<Table> tables = paper_tables(scenario, columns, results.rows);
  for (auto& table : tables)
    for (const auto& note : captions) table.caption += " " + note + ".";
  return tables;
}

std::vector<Table> tables_of(const study::Scenario& shown, const ComparableRows& results,
                             const std::vector<CellLine>& cells) {
  const auto columns = compare_with_paper(shown, results.rows);
  std::vector<std::string> printed;
  printed.reserve(columns.size());
  for (const auto& column : columns) printed.push_back(column.metric.metric);
  std::vector<Table> tables = annotated_paper_tables(shown.name, results, columns);
  const auto add = [&](std::vector<Table> more) {
    for (auto& table : more) tables.push_back(std::move(table));
  };
  add(agreement_tables(shown.name, columns));
  add(departure_tables(shown.name, columns));
  add(result_tables(shown, results, printed));
  add(paired_tables(shown, results, cells));
  return tables;
}

}  // namespace

ScenarioResults scenario_results(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows,
                                 const std::vector<CellLine>& cells) {
  const ComparableRows results = comparable_rows(scenario, rows, cells);
  const study::Scenario shown = restricted(scenario, results);
  ScenarioResults all{.overview = overview_table(shown, results), .tables = tables_of(shown, results, cells)};
  if (!all.overview) return all;
  const std::string best = overview_sentence(*all.overview);
  const std::string odometry = odometry_sentence(results);
  all.answer = best + (best.empty() || odometry.empty() ? "" : " ") + odometry;
  return all;
}

}  // namespace scanbench::results
