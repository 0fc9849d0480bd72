// Makes the ranking table of a benchmark: values with intervals, and the best of each column marked.
#include "harness/results/tables/ranking_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/results/tables/table_marks.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;

constexpr double kRounding = 1e-9;  ///< a difference of exactly the margin is within it

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

/// Larger values get fewer decimals if a column spans decades.
TableCell interval_cell(const RankedPipeline& ranked, const study::BenchmarkColumn& column) {
  const MeanInterval& interval = ranked.values.at(column.metric);
  if (!std::isfinite(interval.mean)) return {"–"};
  const double mean = interval.mean * column.scale;
  const int large = column.geometric ? static_cast<int>(mean >= 10) + static_cast<int>(mean >= 100) : 0;
  const int decimals = std::max(0, column.decimals - large);
  TableCell cell{number(mean, decimals)};
  if (interval.count > 1)
    cell.spread =
        number(interval.low * column.scale, decimals) + " to " + number(interval.high * column.scale, decimals);
  if (const auto range = ranked.ranges.find(column.metric); range != ranked.ranges.end())
    cell.spread += (cell.spread.empty() ? "" : "; ") + fmt::format("conditions {} to {}",
                                                                   number(range->second.least * column.scale, decimals),
                                                                   number(range->second.most * column.scale, decimals));
  return cell;
}

TableCell next_cell(const RankedPipeline& ranked, const study::BenchmarkColumn& rank) {
  if (ranked.next.count == 0) return {"–"};
  const auto text = [&](double difference) {
    return rank.geometric ? fmt::format("× {:.3f}", std::exp(difference))
                          : fmt::format("{:+.2f}", rank.scale * difference);
  };
  TableCell cell{text(ranked.next.mean)};
  if (ranked.next.count > 1) cell.spread = text(ranked.next.low) + " to " + text(ranked.next.high);
  return cell;
}

const study::BenchmarkColumn& column_of(const study::BenchmarkSubject& subject, const std::string& metric) {
  return *std::ranges::find(subject.columns, metric, &study::BenchmarkColumn::metric);
}

/// Whether each pipeline answers about as much as the one that answers most; false for those that miss cells.
std::vector<bool> answers_enough(const std::vector<RankedPipeline>& ranking, const study::BenchmarkSubject& subject) {
  const metrics::MetricDescription fair = column_of(subject, subject.fair.metric).description();
  double least = kNaN;
  std::vector<double> costs;
  for (const auto& ranked : ranking) {
    costs.push_back(metrics::cost(fair, ranked.values.at(fair.metric).mean));
    if (ranked.missing == 0 && !(costs.back() >= least)) least = costs.back();
  }
  std::vector<bool> enough;
  for (std::size_t r = 0; r < ranking.size(); ++r)
    enough.push_back(ranking[r].missing == 0 && costs[r] <= least + subject.fair.margin + kRounding);
  return enough;
}

/// Whether the first column of each pipeline is good enough for its times to be compared.
std::vector<bool> errs_little_enough(const std::vector<RankedPipeline>& ranking,
                                     const study::BenchmarkSubject& subject) {
  const std::string& rank = subject.rank_column().metric;
  double least = kNaN;
  for (const auto& ranked : ranking)
    if (const double value = ranked.values.at(rank).mean; ranked.missing == 0 && !(value >= least)) least = value;
  std::vector<bool> enough;
  enough.reserve(ranking.size());
  for (const auto& ranked : ranking)
    enough.push_back(subject.fair.times == 0.0 || ranked.values.at(rank).mean <= subject.fair.times * least);
  return enough;
}

/// The head of a benchmark's column; pages show which values are better.
TableColumn ranked_column(const study::BenchmarkColumn& column, const study::BenchmarkSpec& spec) {
  const std::string head = column.metric == "t_ratio" ? "time / " + spec.baseline : column.head;
  metrics::MetricDescription metric = column.description();
  metric.label = head;
  return {"", head, false, metric.metric, page_heading(metric, {"", column.scale})};
}

void mark_columns(Table& table, const std::vector<RankedPipeline>& ranking, const study::BenchmarkSubject& subject) {
  const std::vector<bool> enough = answers_enough(ranking, subject);
  const std::vector<bool> accurate = errs_little_enough(ranking, subject);
  std::size_t c = 0;
  for (const auto& column : subject.columns) {
    const bool is_time = column.metric == subject.time_metric || column.metric == "t_ratio";
    std::vector<TableCell*> cells;
    std::vector<std::vector<double>> seeds;
    std::vector<bool> eligible;
    for (std::size_t r = 0; r < ranking.size(); ++r) {
      cells.push_back(&table.rows[r].cells[c]);
      seeds.push_back(ranking[r].by_seed.at(column.metric));
      eligible.push_back(ranking[r].missing == 0 && (enough[r] || column.direction == Direction::higher_is_better) &&
                         (accurate[r] || !is_time));
    }
    mark_best(cells, seeds, column.description(), eligible);
    ++c;
  }
}

}  // namespace

Table ranking_table(const std::vector<RankedPipeline>& ranking, const study::BenchmarkSpec& spec) {
  const study::BenchmarkSubject& subject = spec.subject();
  Table table{"ranking", "", "", {"", subject.noun}, {}, {}};
  for (const auto& column : subject.columns) table.columns.push_back(ranked_column(column, spec));
  table.columns.push_back({"", next_head(subject.rank_column()), false});
  table.columns.push_back({"", "best in", false});
  int rank = 0;
  for (const auto& ranked : ranking) {
    const std::string missing = ranked.missing > 0 ? fmt::format(" ({} cells missing)", ranked.missing) : "";
    Table::Row row{{std::to_string(++rank), ranked.name + missing}, {}, false};
    for (const auto& column : subject.columns) row.cells.push_back(interval_cell(ranked, column));
    row.cells.push_back(next_cell(ranked, subject.rank_column()));
    row.cells.push_back({std::to_string(ranked.conditions_won)});
    table.rows.push_back(std::move(row));
  }
  mark_columns(table, ranking, subject);
  table.caption = subject.fair.caption;
  return table;
}

}  // namespace scanbench::results
