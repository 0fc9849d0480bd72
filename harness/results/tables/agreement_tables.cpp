// Makes tables of orderings, best methods, correlations and departures.
#include "harness/results/tables/agreement_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "harness/results/analysis/statistics.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "harness/study/scenario/published.hpp"

namespace scanbench::results {
namespace {

constexpr const char* kTitle = "agreement with the published tables";

bool has_ours(const ComparedColumn& column) {
  return std::ranges::any_of(column.cells, [](const ComparedCell& cell) {
    return !std::isnan(cell.paper) && std::ranges::any_of(cell.ours, [](double v) { return !std::isnan(v); });
  });
}

std::vector<const ComparedColumn*> compared(const std::vector<ComparedColumn>& columns) {
  std::vector<const ComparedColumn*> result;
  for (const auto& column : columns)
    if (has_ours(column)) result.push_back(&column);
  return result;
}

std::string spread(const std::vector<double>& per_seed, int decimals) {
  if (per_seed.empty()) return "–";
  const auto [low, high] = std::ranges::minmax_element(per_seed);
  if (decimals == 0) return fmt::format("{:g} / {:g} / {:g}", *low, median(per_seed), *high);  // a median may end in .5
  return fmt::format("{:.{}f} / {:.{}f} / {:.{}f}", *low, decimals, median(per_seed), decimals, *high, decimals);
}

// Names what an ordering compares: two families at one setting, or one family over its settings.
std::string pair_of(const ComparedColumn& column, const Ordering& ordering) {
  const auto [low, high] = std::minmax(ordering.lower, ordering.upper);
  const study::MethodName a = study::split_method(column.methods[low].published);
  const study::MethodName b = study::split_method(column.methods[high].published);
  if (a.family != b.family) return a.family + " and " + b.family + (a.setting.empty() ? "" : " at one setting");
  return a.family + " along " + a.setting.substr(0, a.setting.find('='));
}

struct Held {
  std::size_t held = 0;
  std::size_t stated = 0;
  TableCell cell() const { return {stated == 0 ? "" : fmt::format("{} of {}", held, stated), false, false}; }
};

// Counts the orderings that hold in the median, in rows by `row_of`, with the sum and the spread over seeds below.
Table orderings_table(const std::string& scenario, const std::vector<const ComparedColumn*>& columns,
                      const std::string& head, const std::string& what,
                      const std::function<std::string(const ComparedColumn&, const Ordering&)>& row_of) {
  Table table{
      scenario + "-orderings-" + head,
      scenario + ": " + kTitle + ": orderings " + what,
      "Number of orderings of two methods that the printed values imply and our medians show. Printed ties imply none.",
      {head},
      {},
      {}};
  std::vector<std::string> rows;
  std::map<std::string, std::map<const ComparedColumn*, Held>> counts;
  std::map<const ComparedColumn*, Held> sums;
  for (const auto* column : columns)
    for (const auto& ordering : orderings(*column)) {
      const std::string row = row_of(*column, ordering);
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
      for (Held* count : {&counts[row][column], &sums[column]}) {
        ++count->stated;
        count->held += ordering.holds;
      }
    }
  for (const auto& row : rows) table.rows.push_back({{row}, {}, false});
  table.rows.push_back({{"all"}, {}, false});
  const bool seeds = columns.front()->seeds > 1;
  if (seeds) table.rows.push_back({{"all, per seed: min / median / max"}, {}, false});
  for (const auto* column : columns) {
    if (sums[column].stated == 0) continue;
    table.columns.push_back({"", column->metric.metric, false, column->metric.metric, words_of(column->metric)});
    for (std::size_t r = 0; r < rows.size(); ++r) table.rows[r].cells.push_back(counts[rows[r]][column].cell());
    table.rows[rows.size()].cells.push_back(sums[column].cell());
    if (seeds) table.rows[rows.size() + 1].cells.push_back({spread(orderings_per_seed(*column), 0), false, false});
  }
  return table;
}

Table best_table(const std::string& scenario, const std::vector<const ComparedColumn*>& columns) {
  Table table{
      scenario + "-best",
      scenario + ": " + kTitle + ": on how many lines a method is best",
      fmt::format("Number of the {} lines on which no other method is better; alone: on which every other is worse. "
                  "Single seeds: min / median / max.",
                  columns.front()->printed_subjects()),
      {"metric", "method"},
      {{"", "paper", true},
       {"best", "medians", false},
       {"best", "single seeds", false},
       {"best alone", "medians", false},
       {"best alone", "single seeds", false}},
      {}};
  for (const auto* column : columns) {
    const auto shared = best_counts(*column, Ties::shared);
    const auto alone = best_counts(*column, Ties::nobodys);
    for (std::size_t i = 0; i < shared.size(); ++i)
      table.rows.push_back({{words_of(column->metric), column->methods[shared[i].method].published},
                            {{std::to_string(shared[i].paper), false, true},
                             {std::to_string(shared[i].median), false, false},
                             {spread(shared[i].per_seed, 0), false, false},
                             {std::to_string(alone[i].median), false, false},
                             {spread(alone[i].per_seed, 0), false, false}},
                            false});
  }
  return table;
}

Table correlation_table(const std::string& scenario, const std::vector<const ComparedColumn*>& columns) {
  Table table{scenario + "-correlation",
              scenario + ": " + kTitle + ": correlation of the cells",
              "Pearson's correlation of our values with the printed ones.",
              {"metric"},
              {{"", "cells", false}, {"", "medians", false}, {"", "per seed: min / median / max", false}},
              {}};
  for (const auto* column : columns) {
    const Correlation r = correlation(*column);
    if (r.cells < 3 || std::isnan(r.of_medians)) continue;
    table.rows.push_back({{words_of(column->metric)},
                          {{std::to_string(r.cells), false, false},
                           {fmt::format("{:.3f}", r.of_medians), false, false},
                           {spread(r.per_seed, 3), false, false}},
                          false});
  }
  return table;
}

}  // namespace

std::vector<Table> agreement_tables(const std::string& scenario, const std::vector<ComparedColumn>& all) {
  const auto columns = compared(all);
  std::vector<Table> tables;
  if (columns.empty()) return tables;
  const bool lines = std::ranges::any_of(columns, [](const auto* column) { return column->of_lines(); });
  if (lines)
    tables.push_back(orderings_table(scenario, columns, "line", "by line",
                                     [](const auto& column, const auto& o) { return column.subjects[o.subject]; }));
  tables.push_back(orderings_table(scenario, columns, "methods", "by pair of methods", pair_of));
  if (lines) tables.push_back(best_table(scenario, columns));
  tables.push_back(correlation_table(scenario, columns));
  std::erase_if(tables, [](const Table& table) { return table.rows.empty() || table.columns.empty(); });
  return tables;
}

std::vector<Table> departure_tables(const std::string& scenario, const std::vector<ComparedColumn>& all) {
  Table table{scenario + "-departures",
              scenario + ": " + kTitle + ": departures",
              "Orderings that the printed values imply and our medians do not show.",
              {"metric", "line", "the paper has"},
              {{"paper", "lower", true},
               {"paper", "higher", true},
               {"ours", "lower", false},
               {"ours", "higher", false},
               {"", "seeds that show it", false}},
              {}};
  std::size_t stated = 0;
  auto columns = compared(all);
  std::stable_partition(columns.begin(), columns.end(), [](const auto* column) { return !column->metric.timing; });
  for (const auto* column : columns) {
    double largest = 0.0;
    for (const auto& cell : column->cells)
      if (!std::isnan(cell.our_median())) largest = std::max(largest, std::abs(cell.our_median()));
    const Display display = display_for(column->metric.unit, largest);
    // Where our values need another unit than the printed ones, each value has its own and the metric none.
    const bool own_units = !column->printed_unit.empty() && column->printed_unit != display.unit;
    const auto with_unit = [&](const std::string& text, const std::string& unit) {
      return own_units && !text.empty() && text != "–" ? text + " " + unit : text;
    };
    const auto shown = [&](double value) { return with_unit(value_text(value, display), display.unit); };
    for (const auto& ordering : orderings(*column)) {
      ++stated;
      if (ordering.holds) continue;
      const ComparedCell& lower = column->at(ordering.subject, ordering.lower);
      const ComparedCell& upper = column->at(ordering.subject, ordering.upper);
      table.rows.push_back(
          {{heading(words_of(column->metric), own_units ? Display{} : display), column->subjects[ordering.subject],
            column->methods[ordering.lower].published + " < " + column->methods[ordering.upper].published},
           {{with_unit(lower.printed, column->printed_unit), false, true},
            {with_unit(upper.printed, column->printed_unit), false, true},
            {shown(lower.our_median()), false, false},
            {shown(upper.our_median()), false, false},
            {fmt::format("{} of {}", ordering.seeds_holding, column->seeds), false, false}},
           false});
    }
  }
  if (stated == 0) return {};
  table.title += fmt::format(" ({} of {} orderings)", table.rows.size(), stated);
  table.pages_only = true;
  return {table};
}

}  // namespace scanbench::results
