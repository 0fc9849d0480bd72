// Makes the ranking table of a benchmark: values with intervals, and the best of each column marked.
#include "harness/report/ranking_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/report/table_marks.hpp"

namespace scanbench::harness {
namespace {

using metrics::Direction;

constexpr double kF1Margin = 0.05;
constexpr double kRounding = 1e-9;  ///< a difference of exactly the margin is within it

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

/// Larger values get fewer decimals if a column spans decades.
TableCell interval_cell(const MeanInterval& interval, const BenchmarkColumn& column) {
  if (!std::isfinite(interval.mean)) return {"–"};
  const double mean = interval.mean * column.scale;
  const int large = column.geometric ? static_cast<int>(mean >= 10) + static_cast<int>(mean >= 100) : 0;
  const int decimals = std::max(0, column.decimals - large);
  TableCell cell{number(mean, decimals)};
  if (interval.count > 1) cell.spread = "± " + number(interval.half_width() * column.scale, decimals);
  return cell;
}

TableCell next_cell(const RankedPipeline& ranked) {
  if (!std::isfinite(ranked.next_p)) return {"–"};
  TableCell cell{fmt::format("{:+.2f}", 100.0 * ranked.next_difference)};
  cell.spread = ranked.next_p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", ranked.next_p);
  if (ranked.next_p >= 0.05) cell.spread += " n.s.";
  return cell;
}

/// Errors and costs are compared among extractors that find about equally much, because one that finds little also has
/// small errors.
void mark_columns(Table& table, const std::vector<RankedPipeline>& ranking) {
  double best_f1 = kNaN;
  for (const auto& ranked : ranking) {
    const double f1 = ranked.values.at("f1").mean;
    if (ranked.missing == 0 && (std::isnan(best_f1) || f1 > best_f1)) best_f1 = f1;
  }
  std::size_t c = 0;
  for (const auto& column : benchmark_columns()) {
    std::vector<TableCell*> cells;
    std::vector<double> means;
    std::vector<bool> eligible;
    for (std::size_t r = 0; r < ranking.size(); ++r) {
      cells.push_back(&table.rows[r].cells[c]);
      means.push_back(ranking[r].values.at(column.metric).mean);
      const bool finds_enough = ranking[r].values.at("f1").mean >= best_f1 - kF1Margin - kRounding;
      eligible.push_back(ranking[r].missing == 0 && (finds_enough || column.direction == Direction::higher_is_better));
    }
    mark_best(cells, means, column.description(), eligible);
    ++c;
  }
}

}  // namespace

Table ranking_table(const std::vector<RankedPipeline>& ranking, const BenchmarkSpec& spec) {
  Table table{"ranking", "", "", {"", "extractor"}, {}, {}};
  for (const auto& column : benchmark_columns())
    table.columns.push_back({"", column.metric == "t_ratio" ? "time / " + spec.baseline : column.head, false});
  table.columns.push_back({"", "F1 − next", false});
  table.columns.push_back({"", "best in", false});
  int rank = 0;
  for (const auto& ranked : ranking) {
    const std::string missing = ranked.missing > 0 ? fmt::format(" ({} cells missing)", ranked.missing) : "";
    Table::Row row{{std::to_string(++rank), ranked.name + missing}, {}, false};
    for (const auto& column : benchmark_columns())
      row.cells.push_back(interval_cell(ranked.values.at(column.metric), column));
    row.cells.push_back(next_cell(ranked));
    row.cells.push_back({std::to_string(ranked.conditions_won)});
    table.rows.push_back(std::move(row));
  }
  mark_columns(table, ranking);
  table.caption = fmt::format(
      "* marks the best value; of errors, times and other costs among extractors within {} points of the best F1. An "
      "extractor with missing cells has no mark.",
      100.0 * kF1Margin);
  return table;
}

}  // namespace scanbench::harness
