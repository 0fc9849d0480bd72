// Values with their intervals, the best of each column marked.
#include "harness/report/ranking_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanbench::harness {
namespace {

using metrics::Direction;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

/// Fewer decimals for larger values where a column spans decades.
TableCell interval_cell(const Interval& interval, const BenchmarkColumn& column) {
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
  std::size_t c = 0;
  for (const auto& column : benchmark_columns()) {
    double best = kNan;
    for (const auto& ranked : ranking) {
      const double v = ranked.values.at(column.metric).mean;
      const bool better = column.direction == Direction::lower_is_better ? v < best : v > best;
      if (std::isnan(best) || better) best = v;
    }
    for (std::size_t r = 0; r < ranking.size(); ++r)
      table.rows[r].cells[c].best = ranking[r].values.at(column.metric).mean == best;
    ++c;
  }
  return table;
}

}  // namespace scanbench::harness
