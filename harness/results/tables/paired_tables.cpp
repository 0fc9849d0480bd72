// Makes tables of differences and ratios of pairs of pipelines, and of seeds that are not placed.
#include "harness/results/tables/paired_tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/special_values.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/results/tables/table_marks.hpp"

namespace scanbench::results {
namespace {

using BySeed = std::map<std::uint64_t, double>;
constexpr std::size_t kMostSeedsNamed = 5;

BySeed values_of(const ComparableRows& results, const std::string& pipeline, const std::string& metric) {
  BySeed values;
  for (const runs::SummaryRow& row : results.rows)
    if (row.pipeline == pipeline && row.metric == metric && row.subject == "all") values[row.seed] = row.value;
  return values;
}

/// "0.47 (0.42 to 0.53)".
std::string with_interval(const MeanInterval& interval, const Display& display) {
  if (interval.count == 0) return value_text(kNaN, display);
  return fmt::format("{} ({} to {})", value_text(interval.mean, display), value_text(interval.low, display),
                     value_text(interval.high, display));
}

struct Pair {
  MeanInterval difference;
  MeanInterval ratio;  ///< geometric mean
  std::size_t smaller = 0;
  std::size_t seeds = 0;
};

Pair compare(const BySeed& first, const BySeed& second) {
  Pair pair;
  std::vector<double> differences, logarithms;
  for (const auto& [seed, a] : first) {
    const auto other = second.find(seed);
    if (other == second.end() || !std::isfinite(a) || !std::isfinite(other->second)) continue;
    const double b = other->second;
    ++pair.seeds;
    pair.smaller += a < b ? 1 : 0;
    differences.push_back(a - b);
    if (a > 0 && b > 0) logarithms.push_back(std::log(a / b));
  }
  pair.difference = seed_interval(differences, ValueRange::any);
  const MeanInterval log_ratio =
      seed_interval(logarithms.size() == differences.size() ? logarithms : std::vector<double>(), ValueRange::any);
  pair.ratio = {std::exp(log_ratio.mean), std::exp(log_ratio.low), std::exp(log_ratio.high), log_ratio.count};
  return pair;
}

/// Every pair of pipelines by one error; no rows if fewer than two pipelines have it.
Table pairs_by(const std::string& metric, const study::Scenario& scenario, const ComparableRows& results) {
  Table table{
      "paired_" + metric,
      fmt::format("{}: {}, seed by seed", scenario.name, metric_descriptions().at(metric).label),
      fmt::format("Means over {} seeds with {}, paired: both pipelines on the same recordings. The ratio is a "
                  "geometric mean.",
                  results.seeds.size(),
                  results.seeds.size() < kFewestForInterval ? "the smallest and the largest value" : "95 % intervals"),
      {"pipeline", "against"},
      {},
      {}};
  double largest = 0.0;
  for (const runs::SummaryRow& row : results.rows)
    if (row.metric == metric && std::isfinite(row.value)) largest = std::max(largest, row.value);
  const Display length = display_for("m", largest);
  table.columns = {{"", heading("difference", length), false}, {"", "ratio", false}, {"", "smaller in", false}};
  for (std::size_t i = 0; i < results.pipelines.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Pair pair =
          compare(values_of(results, results.pipelines[i], metric), values_of(results, results.pipelines[j], metric));
      if (pair.seeds < 2) continue;
      table.rows.push_back({{results.pipelines[i], results.pipelines[j]},
                            {{with_interval(pair.difference, length)},
                             {with_interval(pair.ratio, {})},
                             {fmt::format("{} of {} seeds", pair.smaller, pair.seeds)}},
                            false});
    }
  return table;
}

std::string said_of(const std::vector<CellLine>& cells, const study::Scenario& scenario, const std::string& pipeline,
                    std::uint64_t seed) {
  for (const CellLine& cell : cells)
    if (cell.scenario == scenario.name && cell.pipeline == pipeline && cell.seed == seed) return cell.message;
  return {};
}

/// The seeds in which a pipeline left scans unplaced, the worst scan of each, and what was said in the first of them.
Table unplaced_seeds(const study::Scenario& scenario, const ComparableRows& results,
                     const std::vector<CellLine>& cells) {
  Table table{
      "unplaced",
      scenario.name + ": seeds in which not all scans were placed",
      "In brackets the largest position and heading error of a scan of the seed, each by itself.",
      {"pipeline"},
      {{"", "all placed in", false}, {"", "not in seeds", false}, {"", "what it said in the first of them", false}},
      {}};
  for (const std::string& pipeline : results.pipelines) {
    const BySeed placed = values_of(results, pipeline, "all_placed");
    if (placed.empty()) continue;
    const BySeed position = values_of(results, pipeline, "position_error_max");
    const BySeed turn = values_of(results, pipeline, "heading_error_max");
    std::vector<std::uint64_t> others;
    for (const auto& [seed, all] : placed)
      if (all < 1.0) others.push_back(seed);
    std::string text;
    for (std::size_t k = 0; k < std::min(others.size(), kMostSeedsNamed); ++k)
      text += fmt::format("{}{} ({:.3g} m, {:.2g} deg)", k > 0 ? ", " : "", others[k], position.at(others[k]),
                          turn.at(others[k]));
    if (others.size() > kMostSeedsNamed) text += fmt::format(" and {} more", others.size() - kMostSeedsNamed);
    std::string said = others.empty() ? "" : said_of(cells, scenario, pipeline, others.front());
    if (!others.empty() && said.empty()) said = "nothing";
    table.rows.push_back(
        {{pipeline}, {{fmt::format("{} of {}", placed.size() - others.size(), placed.size())}, {text}, {said}}, false});
  }
  return table;
}

}  // namespace

std::vector<Table> paired_tables(const study::Scenario& scenario, const ComparableRows& results,
                                 const std::vector<CellLine>& cells) {
  std::vector<Table> tables;
  if (results.seeds.size() < 2 || results.pipelines.size() < 2) return tables;
  for (const char* metric : {"position_error", "relations_position"})
    if (Table table = pairs_by(metric, scenario, results); !table.rows.empty()) tables.push_back(std::move(table));
  if (Table table = unplaced_seeds(scenario, results, cells); !table.rows.empty()) tables.push_back(std::move(table));
  return tables;
}

}  // namespace scanbench::results
