// Makes the matrices of pipelines and scenarios.
#include "harness/results/nightly/status_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "harness/results/analysis/verdict.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/tables/table_marks.hpp"

namespace scanbench::results {
namespace {

using Place = std::pair<std::string, std::string>;  // scenario, pipeline

/// Scenarios with the same pipelines.
struct MatrixGroup {
  std::vector<std::string> scenarios;
  std::vector<std::string> pipelines;
};

/// The findings of a comparison about one pipeline in one scenario.
struct State {
  std::size_t gates = 0, worse = 0, better = 0, uncertain = 0, same = 0;
  std::size_t failed = 0, missing = 0, added = 0;  // cells
  std::vector<const MetricChange*> changes;
};

std::vector<MatrixGroup> groups_of(const RunResults& now, const Comparison& comparison) {
  std::vector<std::pair<std::string, std::vector<std::string>>> scenarios;  // in order, with their pipelines
  const auto add = [&](const runs::CellKey& key) {
    auto scenario =
        std::ranges::find(scenarios, key.scenario, &std::pair<std::string, std::vector<std::string>>::first);
    if (scenario == scenarios.end()) scenario = scenarios.insert(scenario, {key.scenario, {}});
    if (std::ranges::find(scenario->second, key.pipeline) == scenario->second.end())
      scenario->second.push_back(key.pipeline);
  };
  for (const auto& cell : now.cells)
    if (cell.requested) add(cell.key);
  for (const runs::CellKey& key : comparison.missing) add(key);
  std::vector<MatrixGroup> groups;
  for (auto& [name, pipelines] : scenarios) {
    const auto known = std::ranges::find_if(groups, [&, &of = pipelines](const MatrixGroup& group) {
      return std::ranges::is_permutation(group.pipelines, of);
    });
    if (known != groups.end())
      known->scenarios.push_back(name);
    else
      groups.push_back({{name}, std::move(pipelines)});
  }
  return groups;
}

std::map<Place, State> states_of(const Comparison& comparison) {
  std::map<Place, State> states;
  for (const auto& change : comparison.changes) {
    State& state = states[{change.scenario, change.pipeline}];
    state.changes.push_back(&change);
    if (!change.gate) continue;
    ++state.gates;
    state.worse += change.finding == Finding::worse ? 1U : 0U;
    state.better += change.finding == Finding::better ? 1U : 0U;
    state.uncertain += change.finding == Finding::uncertain ? 1U : 0U;
    state.same += change.finding == Finding::same ? 1U : 0U;
  }
  for (const auto* cells : {&comparison.broken, &comparison.failing})
    for (const auto& change : *cells) ++states[{change.cell.scenario, change.cell.pipeline}].failed;
  for (const auto& key : comparison.missing) ++states[{key.scenario, key.pipeline}].missing;
  for (const auto& key : comparison.added) ++states[{key.scenario, key.pipeline}].added;
  return states;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// "f1 −0.031": the change with this finding that is largest in units of its tolerance.
std::string largest_change(const State& state, Finding finding) {
  const MetricChange* largest = nullptr;
  for (const MetricChange* change : state.changes)
    if (change->gate && change->finding == finding && (largest == nullptr || severity(*change) > severity(*largest)))
      largest = change;
  if (largest == nullptr) return "";
  if (largest->lost > 0 || !std::isfinite(largest->difference.mean)) return largest->metric.metric + " undefined";
  const Display display = display_for(largest->metric.unit, std::fabs(largest->difference.mean));
  return fmt::format("{} {}{}{}{}", largest->metric.metric, largest->difference.mean < 0 ? "" : "+",
                     value_text(largest->difference.mean, display), display.unit.empty() ? "" : " ", display.unit);
}

/// "f1 0.931": the value by which the group is ranked.
std::string ranked_value(const State& state, const std::string& scenario, const std::vector<MethodRanking>& rankings) {
  for (const auto& ranking : rankings) {
    if (std::ranges::find(ranking.scenarios, scenario) == ranking.scenarios.end()) continue;
    for (const MetricChange* change : state.changes) {
      if (change->metric.metric != ranking.quality.metric || !std::isfinite(change->after)) continue;
      const Display display = display_for(change->metric.unit, std::fabs(change->after));
      return fmt::format("{} {}{}{}", change->metric.metric, value_text(change->after, display),
                         display.unit.empty() ? "" : " ", display.unit);
    }
  }
  return "";
}

/// The worst that happened, first.
TableCell cell_of(const State& state, const std::string& ranked) {
  const auto cell = [](std::string text, const char* kind, std::string value) {
    return TableCell{.text = std::move(text), .spread = std::move(value), .state = kind};
  };
  if (state.failed > 0) return cell("✗ " + counted(state.failed, "cell failed", "cells failed"), "failed", "");
  if (state.missing > 0) return cell("∅ " + counted(state.missing, "cell missing", "cells missing"), "missing", "");
  if (state.worse > 0)
    return cell(
        fmt::format("▼ {} worse", state.worse) + (state.better > 0 ? fmt::format(", ▲ {} better", state.better) : ""),
        "worse", largest_change(state, Finding::worse));
  if (state.uncertain > 0)
    return cell(fmt::format("? {} uncertain", state.uncertain), "uncertain", largest_change(state, Finding::uncertain));
  if (state.better > 0)
    return cell("▲ " + fmt::format("{} better", state.better), "better", largest_change(state, Finding::better));
  if (state.added > 0) return cell("+ new", "", ranked);
  if (state.gates == 0) return cell("–", "", "");
  return cell(state.same == state.gates ? "= same" : "≈ within", "", ranked);
}

}  // namespace

Blocks status_matrices(const RunResults& now, const Comparison& comparison, const std::vector<MethodRanking>& rankings,
                       const std::string& report) {
  const std::map<Place, State> states = states_of(comparison);
  if (states.empty()) return {};
  const auto cell_at = [&](const std::string& scenario, const std::string& pipeline) {
    const auto state = states.find({scenario, pipeline});
    if (state == states.end()) return TableCell{"–"};
    TableCell cell = cell_of(state->second, ranked_value(state->second, scenario, rankings));
    if (!report.empty()) cell.link = report + "#" + scenario;
    return cell;
  };
  BlockGroup matrices{"matrices", {}};
  for (const auto& group : groups_of(now, comparison)) {
    Table table{"", "", "", {"pipeline"}, {}, {}};
    for (const auto& scenario : group.scenarios) table.columns.push_back({"", scenario});
    for (const auto& pipeline : group.pipelines) {
      Table::Row row{{pipeline}, {}, false};
      for (const auto& scenario : group.scenarios) row.cells.push_back(cell_at(scenario, pipeline));
      table.rows.push_back(std::move(row));
    }
    table.side_by_side = group.scenarios.size() == 1;  // a column would be long and narrow
    if (table.side_by_side) table.title = group.scenarios.front();
    matrices.blocks.push_back(std::move(table));
  }
  return {
      Paragraph{"Counts are of gates. ▼ worse, ▲ better, = same to the bit, ≈ changed within the tolerances, ? changed "
                "by more but not on enough seeds, ✗ not ok, ∅ missing. Below is the largest change, else the value by "
                "which the pipelines are ranked.",
                "caption"},
      std::move(matrices)};
}

}  // namespace scanbench::results
