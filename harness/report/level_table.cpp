// Makes the table of a benchmark's levels, and the sentence that names the best pipeline of each.
#include "harness/report/level_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/index.hpp"
#include "harness/report/table_marks.hpp"

namespace scanbench::harness {
namespace {

/// "F1 [%]" without its unit.
std::string short_head(const BenchmarkColumn& rank) {
  return rank.head.substr(0, rank.head.find(" ["));
}

/// "noise 5cm"
std::string name_of(const LevelResult& result) {
  return result.factor + " " + result.level;
}

/// The pipeline that is best at most levels; the first of these if several are.
int best_at_most(const std::vector<LevelResult>& results) {
  std::map<int, int> wins;
  for (const auto& result : results)
    if (result.best >= 0) ++wins[result.best];
  const auto most = std::ranges::max_element(wins, {}, [](const auto& win) { return win.second; });
  return most == wins.end() ? -1 : most->first;
}

}  // namespace

Table level_table(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                  const BenchmarkSpec& spec) {
  const BenchmarkColumn& rank = spec.subject().rank_column();
  Table table{"levels", rank.head + " by condition", "", {spec.subject().noun}, {}, {}};
  for (const auto& name : names) table.rows.push_back({{name}, {}, false});
  for (const auto& result : results) {
    table.columns.push_back({result.factor, result.level, false});
    std::vector<double> means;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double mean = result.values[i].mean;
      means.push_back(mean);
      table.rows[i].cells.push_back(
          {std::isfinite(mean) ? fmt::format("{:.{}f}", rank.scale * mean, rank.decimals) : "–"});
    }
    std::vector<TableCell*> cells;
    for (auto& row : table.rows) cells.push_back(&row.cells.back());
    mark_best(cells, means, rank.description());
  }
  table.caption = "Means over all conditions of one level. * marks the best of a column. – marks missing cells.";
  return table;
}

std::string best_by_level_text(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                               const BenchmarkSpec& spec) {
  const int most = best_at_most(results);
  if (most < 0) return "";
  std::vector<std::string> at_most, doubtful;
  std::map<int, std::vector<std::string>> others;
  for (const auto& result : results) {
    if (result.best == most) at_most.push_back(name_of(result));
    if (result.best >= 0 && result.best != most) others[result.best].push_back(name_of(result));
    if (result.p >= 0.05)
      doubtful.push_back(
          fmt::format("{} ({} and {})", name_of(result), names[as_index(result.best)], names[as_index(result.second)]));
  }
  std::string text =
      fmt::format("{} has the best {} ", names[as_index(most)], short_head(spec.subject().rank_column()));
  text += others.empty() ? "at every level" : fmt::format("at {}", fmt::join(at_most, ", "));
  for (const auto& [best, levels] : others)
    text += fmt::format("; {} at {}", names[as_index(best)], fmt::join(levels, ", "));
  text += ".";
  if (!doubtful.empty())
    text +=
        fmt::format(" The seeds do not separate the best two at {} (paired t tests, Holm).", fmt::join(doubtful, ", "));
  return text;
}

}  // namespace scanbench::harness
