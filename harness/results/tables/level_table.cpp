// Makes the table of a benchmark's levels, and the sentence that names the best pipeline of each.
#include "harness/results/tables/level_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/index.hpp"
#include "harness/results/tables/table_marks.hpp"

namespace scanbench::results {
namespace {

/// "noise 1cm / 5cm, sensor ladar": levels in their order, those of one factor together.
std::string names_of(const std::vector<const LevelResult*>& results) {
  std::string text, factor;
  for (const LevelResult* result : results) {
    text += result->factor == factor ? " / " : (text.empty() ? "" : ", ") + result->factor + " ";
    text += result->level;
    factor = result->factor;
  }
  return text;
}

/// The pipeline that is best at most levels; the first of these if several are.
int best_at_most(const std::vector<LevelResult>& results) {
  std::map<int, int> wins;
  for (const auto& result : results)
    if (!result.leaders.empty()) ++wins[result.leaders.front()];
  const auto most = std::ranges::max_element(wins, {}, [](const auto& win) { return win.second; });
  return most == wins.end() ? -1 : most->first;
}

}  // namespace

Table level_table(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                  const study::BenchmarkSpec& spec) {
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  Table table{"levels", rank.head + " by condition", "", {spec.subject().noun}, {}, {}};
  for (const auto& name : names) table.rows.push_back({{name}, {}, false});
  for (const auto& result : results) {
    table.columns.push_back({result.factor, result.level, false});
    std::vector<std::vector<double>> seeds;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double mean = result.values[i].mean;
      seeds.push_back(result.by_seed[i]);
      table.rows[i].cells.push_back(
          {std::isfinite(mean) ? fmt::format("{:.{}f}", rank.scale * mean, rank.decimals) : "–"});
    }
    std::vector<TableCell*> cells;
    for (auto& row : table.rows) cells.push_back(&row.cells.back());
    mark_best(cells, seeds, rank.description());
  }
  table.caption =
      "Means over all conditions of one level. * marks the best of a column and those that the seeds do not "
      "separate from it. – marks missing cells.";
  return table;
}

std::string best_by_level_text(const std::vector<LevelResult>& results, const std::vector<std::string>& names,
                               const study::BenchmarkSpec& spec) {
  const int most = best_at_most(results);
  if (most < 0) return "";
  std::map<int, std::vector<const LevelResult*>> best;
  std::vector<const LevelResult*> shared;
  for (const auto& result : results) {
    if (!result.leaders.empty()) best[result.leaders.front()].push_back(&result);
    if (result.leaders.size() > 1) shared.push_back(&result);
  }
  std::string text = fmt::format("{} has the best {} ", names[as_index(most)], spec.subject().rank_column().name());
  text += best.size() == 1 ? "at every level" : "at " + names_of(best.at(most));
  for (const auto& [pipeline, levels] : best)
    if (pipeline != most) text += fmt::format("; {} at {}", names[as_index(pipeline)], names_of(levels));
  text += ".";
  if (shared.empty()) return text;
  return text +
         fmt::format(" The seeds do not separate the best from others at {}; these have a star too.", names_of(shared));
}

}  // namespace scanbench::results
