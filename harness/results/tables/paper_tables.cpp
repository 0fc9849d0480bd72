// Makes tables in the layout of a paper, with its lines and methods.
#include "harness/results/tables/paper_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "harness/results/analysis/statistics.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "harness/study/scenario/published.hpp"

namespace scanbench::results {
namespace {

using Columns = std::vector<const ComparedColumn*>;

// Columns of the same table of the paper, in order.
std::vector<Columns> by_table(const std::vector<ComparedColumn>& columns) {
  std::vector<Columns> tables;
  for (const auto& column : columns) {
    const auto same = [&](const Columns& t) {
      return t.front()->table == column.table && t.front()->of_lines() == column.of_lines();
    };
    const auto table = std::ranges::find_if(tables, same);
    if (table == tables.end())
      tables.push_back({&column});
    else
      table->push_back(&column);
  }
  return tables;
}

int decimals_of(const std::string& printed) {
  const auto point = printed.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(printed.size() - point - 1);
}

// The paper's unit and digits; for times, which are much shorter today, the unit and digits that ours need.
Display display_of(const ComparedColumn& column) {
  double largest = 0.0;
  int decimals = 0;
  for (const auto& cell : column.cells) {
    decimals = std::max(decimals, decimals_of(cell.printed));
    for (const double value : cell.ours)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  if (column.metric.timing) return display_for(column.metric.unit, largest);
  return {column.printed_unit, column.metric.unit == "m" && column.printed_unit == "cm" ? 100.0 : 1.0, decimals};
}

TableCell our_cell(const ComparedCell& cell, const Display& display) {
  std::string text = value_text(cell.our_median(), display);
  const std::string spread = spread_text(median_interval(cell.ours).half_width(), display);
  return {spread.empty() ? text : text + " " + spread, false, false};
}

std::string title_of(const std::string& scenario, const ComparedColumn& column) {
  return column.table.empty() ? scenario + ": published values and ours"
                              : fmt::format("{}: Table {} of the paper and ours", scenario, column.table);
}

std::string caption_of(const ComparedColumn& column) {
  if (column.seeds < 2) return "Under paper: as published.";
  std::string text = fmt::format("Ours: median over {} seeds", column.seeds);
  if (column.seeds >= 6) text += " ± half the width of its 95 % interval";
  return text + "; under paper: as published.";
}

// The subjects of all columns. A paper may print some quantities for fewer lines than others.
std::vector<std::string> subjects_of_all(const Columns& columns) {
  std::vector<std::string> all;
  for (const ComparedColumn* column : columns)
    for (const auto& subject : column->subjects)
      if (std::ranges::count(all, subject) == 0) all.push_back(subject);
  return all;
}

/// Whether a pipeline finds a line at all.
using Finds = std::function<bool(const std::string& pipeline, const std::string& line)>;

Table lines_table(const std::string& scenario, const Columns& columns, const Finds& finds) {
  const ComparedColumn& first = *columns.front();
  Table table{scenario + "-paper-" + first.table,
              title_of(scenario, first),
              caption_of(first) +
                  " * marks the best and those that the seeds do not separate from it; grey: of a "
                  "line that a pipeline misses in most scans.",
              {"line"},
              {},
              {}};
  const std::vector<std::string> subjects = subjects_of_all(columns);
  for (const auto& subject : subjects) table.rows.push_back({{subject}, {}, false});
  for (const ComparedColumn* column : columns) {
    const Display display = display_of(*column);
    for (const auto& [pipeline, published] : column->methods) {
      if (!pipeline.empty()) table.columns.push_back(column_below(column->metric, display, pipeline));
      if (!published.empty())
        table.columns.push_back(column_below(column->metric, display, pipeline.empty() ? published : "paper", true));
    }
    for (std::size_t r = 0; r < subjects.size(); ++r) {
      auto& cells = table.rows[r].cells;
      const std::size_t from = cells.size();
      const auto place = std::ranges::find(column->subjects, subjects[r]);
      if (place == column->subjects.end()) {
        for (std::size_t c = from; c < table.columns.size(); ++c)
          cells.push_back({"–", false, table.columns[c].published});
        continue;
      }
      const auto s = static_cast<std::size_t>(place - column->subjects.begin());
      std::vector<std::vector<double>> ours, theirs;
      std::vector<bool> eligible;
      for (std::size_t m = 0; m < column->methods.size(); ++m) {
        const ComparedCell& cell = column->at(s, m);
        if (!column->methods[m].pipeline.empty()) {
          cells.push_back(our_cell(cell, display));
          ours.push_back(cell.ours);
          eligible.push_back(finds(column->methods[m].pipeline, subjects[r]));
        }
        if (!column->methods[m].published.empty()) {
          cells.push_back({cell.printed, false, true});
          theirs.push_back({cell.paper});
        }
      }
      std::vector<TableCell*> our_cells, their_cells;
      for (std::size_t c = from; c < cells.size(); ++c)
        (cells[c].published ? their_cells : our_cells).push_back(&cells[c]);
      mark_best(our_cells, ours, column->metric, eligible);
      mark_best(their_cells, theirs, column->metric);
    }
  }
  return table;
}

std::string row_head(const ComparedMethod& method) {
  return method.published.empty() ? method.pipeline : method.published;
}

Table methods_table(const std::string& scenario, const Columns& columns) {
  const ComparedColumn& first = *columns.front();
  Table table{scenario + "-paper-" + first.table, title_of(scenario, first), caption_of(first), {"method"}, {}, {}};
  for (const auto& method : first.methods) table.rows.push_back({{row_head(method)}, {}, false});
  for (const ComparedColumn* column : columns) {
    const Display display = display_of(*column);
    // Where today's times need another unit than the printed ones, each value has its own and the head none.
    const bool own_units =
        column->metric.timing && !column->printed_unit.empty() && column->printed_unit != display.unit;
    const Display shown = own_units ? Display{} : display;
    const auto with_unit = [&](std::string text, const std::string& unit) {
      return own_units && !text.empty() && text != "–" ? text + " " + unit : text;
    };
    const bool computed = !column->metric.doc.empty();
    if (computed) table.columns.push_back(column_below(column->metric, shown, "ours"));
    table.columns.push_back(column_below(column->metric, shown, "paper", true));
    for (std::size_t m = 0; m < column->methods.size(); ++m) {
      const ComparedCell& cell = column->at(0, m);
      if (computed) {
        TableCell ours = our_cell(cell, display);
        ours.text = with_unit(std::move(ours.text), display.unit);
        table.rows[m].cells.push_back(std::move(ours));
      }
      table.rows[m].cells.push_back({with_unit(cell.printed, column->printed_unit), false, true});
    }
  }
  return table;
}

// Divides times by the mean time of the first family of methods, because such ratios carry over to another machine.
std::optional<Table> ratio_table(const std::string& scenario, const Columns& columns) {
  const ComparedColumn& first = *columns.front();
  const std::string family = study::split_method(row_head(first.methods.front())).family;
  Table table{scenario + "-ratios-" + first.table,
              fmt::format("{}: times as ratios to {}", scenario, family),
              fmt::format("Times divided by the mean of the {} rows of the same column, ours by ours and the paper's "
                          "by the paper's, because times depend on the machine.",
                          family),
              {"method"},
              {},
              {}};
  for (const auto& method : first.methods) table.rows.push_back({{row_head(method)}, {}, false});
  for (const ComparedColumn* column : columns) {
    if (!column->metric.timing) continue;
    const auto add_ratios = [&](bool published, const std::function<double(const ComparedCell&)>& value) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t m = 0; m < column->methods.size(); ++m) {
        if (study::split_method(row_head(column->methods[m])).family != family) continue;
        sum += value(column->at(0, m));
        ++count;
      }
      table.columns.push_back(column_below(column->metric, {}, published ? "paper" : "ours", published));
      for (std::size_t m = 0; m < column->methods.size(); ++m) {
        const double ratio = value(column->at(0, m)) * count / sum;
        table.rows[m].cells.push_back({std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : "–", false, published});
      }
    };
    add_ratios(false, [](const ComparedCell& cell) { return cell.our_median(); });
    add_ratios(true, [](const ComparedCell& cell) { return cell.paper; });
  }
  return table.columns.empty() ? std::nullopt : std::optional(table);
}

}  // namespace

std::vector<Table> paper_tables(const std::string& scenario, const std::vector<ComparedColumn>& columns,
                                const std::vector<runs::SummaryRow>& rows) {
  const Finds finds = [&rows](const std::string& pipeline, const std::string& line) {
    std::vector<double> missed;
    for (const auto& row : rows)
      if (row.metric == "missed" && row.pipeline == pipeline && row.subject == line) missed.push_back(row.value);
    return !(median(missed) > kMostMissed);
  };
  std::vector<Table> tables;
  for (const auto& table : by_table(columns)) {
    if (table.front()->of_lines()) {
      tables.push_back(lines_table(scenario, table, finds));
      continue;
    }
    tables.push_back(methods_table(scenario, table));
    if (auto ratios = ratio_table(scenario, table)) tables.push_back(std::move(*ratios));
  }
  return tables;
}

}  // namespace scanbench::results
