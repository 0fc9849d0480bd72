// Makes the tables of a comparison, and the document of all of them.
#include "harness/results/nightly/comparison_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "harness/results/analysis/verdict.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

constexpr std::size_t kLargestTable = 200;  ///< rows; more are counted
constexpr std::size_t kListedNew = 5;       ///< rows of new cells, of which a changed suite has many

std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("–");
}

std::string signed_number(double value) {
  return std::isfinite(value) ? fmt::format("{:+.3g}", value) : std::string("–");
}

/// Standard deviations over a few seeds are small by chance, and ratios to them large.
std::string effect_text(double effect) {
  constexpr double kLargest = 10.0;
  if (!std::isfinite(effect)) return "–";
  if (std::fabs(effect) > kLargest) return effect > 0 ? "> 10" : "< -10";
  return fmt::format("{:+.1f}", effect);
}

std::string interval(const MetricChange& change) {
  if (change.by_tolerance()) return "";
  return fmt::format("({:+.3g} … {:+.3g})", change.difference.low, change.difference.high);
}

/// "6 of 7 walls", of which the value is the mean, where a wall has no value in one of the runs, on the seed with most
/// of them.
std::string wall_note(const SubjectCounts& walls) {
  if (walls.uncommon() == 0) return "";
  if (walls.both > 0) return fmt::format("{} of {} walls", walls.both, std::max(walls.before, walls.after));
  return fmt::format("{} walls, before {}", walls.after, walls.before);  // against a baseline
}

/// What the interval comes from: the number of seeds, or the scans of a recorded log.
TableCell sample_cell(const MetricChange& change) {
  if (change.scans)
    return {.text = fmt::format("{} {}", change.scans->count, change.scans->of),
            .spread = fmt::format("in blocks of {}", change.scans->block),
            .hint = "per-scan pairs: " + sample_text(change)};
  TableCell cell{.text = fmt::format("{} seed{}", change.pairs.size(), change.pairs.size() == 1 ? "" : "s"),
                 .spread = wall_note(change.subjects)};
  if (change.by_value.empty()) return cell;
  cell.text = "value only";
  cell.spread = change.by_value;
  return cell;
}

/// The folder of a pipeline's cells, as a link from a page in the run folder.
std::string cells_link(const MetricChange& change) {
  return "cells/" + change.scenario + "/" + change.pipeline + "/";
}

TableCell worst_seed(const MetricChange& change, const std::string& run) {
  const SeedPair* worst = change.finding == Finding::same ? nullptr : change.worst();
  if (worst == nullptr) return {"–"};
  TableCell cell{.text = std::to_string(worst->seed)};
  cell.link = cells_link(change) + cell.text + "/";
  cell.hint = fmt::format("scanbench show {} --scenario {} --pipeline {} --seed {}", shell_word(run), change.scenario,
                          change.pipeline, worst->seed);
  return cell;
}

/// "7", or "3 seeds, first 7".
std::string seeds_text(std::size_t count, std::uint64_t first) {
  return count == 1 ? std::to_string(first) : fmt::format("{} seeds, first {}", count, first);
}

/// One row per pipeline of a scenario, at most `most` of them: the others are counted in one more row.
void add_cells(Table& table, const std::string& what, const std::vector<runs::CellKey>& cells, std::size_t most) {
  std::vector<std::pair<runs::CellKey, std::size_t>> groups;  // first cell, number of cells
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const auto& key : cells) {
    const auto [place, is_new] = places.try_emplace({key.scenario, key.pipeline}, groups.size());
    if (is_new) groups.emplace_back(key, 0);
    ++groups[place->second].second;
  }
  std::size_t listed = 0;
  for (std::size_t i = 0; i < groups.size() && i < most; ++i) {
    const auto& [key, count] = groups[i];
    table.rows.push_back({{what, key.scenario, key.pipeline, seeds_text(count, key.seed), ""}, {}, false});
    listed += count;
  }
  if (groups.size() > most)
    table.rows.push_back({{what, fmt::format("{} more pipelines", groups.size() - most), "",
                           fmt::format("{} cells", cells.size() - listed), ""},
                          {},
                          false});
}

/// One row for all seeds of a pipeline that changed alike.
void add_changes(Table& table, const std::string& what, const std::vector<StatusChange>& changes) {
  using Row = std::tuple<std::string, std::string, std::string>;  // scenario, pipeline, text
  std::vector<std::pair<Row, std::vector<std::uint64_t>>> rows;   // with the seeds
  for (const auto& [key, before, after, message] : changes) {
    const Row row{key.scenario, key.pipeline,
                  before + " → " + after + (message.empty() ? "" : ": " + plain_line(message))};
    auto known = std::ranges::find(rows, row, &decltype(rows)::value_type::first);
    if (known == rows.end()) known = rows.insert(known, {row, {}});
    known->second.push_back(key.seed);
  }
  for (const auto& [row, seeds] : rows) {
    const auto& [scenario, pipeline, text] = row;
    table.rows.push_back({{what, scenario, pipeline, seeds_text(seeds.size(), seeds.front()), text}, {}, false});
  }
}

void shorten(Table& table) {
  if (table.rows.size() <= kLargestTable) return;
  table.caption +=
      fmt::format("{}And {} more rows.", table.caption.empty() ? "" : " ", table.rows.size() - kLargestTable);
  table.rows.resize(kLargestTable);
}

/// Lists the changes of one pipeline in one scenario together, at the place of the first of them.
std::vector<const MetricChange*> by_place(const std::vector<const MetricChange*>& changes) {
  std::map<std::pair<std::string, std::string>, std::size_t> ranks;
  for (const MetricChange* change : changes) ranks.try_emplace({change->scenario, change->pipeline}, ranks.size());
  std::vector<const MetricChange*> grouped = changes;
  std::ranges::stable_sort(grouped, {}, [&](const MetricChange* change) {
    return ranks.at({change->scenario, change->pipeline});
  });
  return grouped;
}

}  // namespace

Table change_table(const std::string& id, const std::string& title, const std::vector<const MetricChange*>& changes,
                   const std::string& run) {
  Table table{id,
              title,
              "",
              {"scenario", "pipeline", "metric"},
              {{"", "before"},
               {"", "now"},
               {"", "difference"},
               {"", "tolerance"},
               {"", "effect"},
               {"", "q"},
               {"", "over"},
               {"", "worst seed"}},
              {}};
  for (const MetricChange* change : by_place(changes)) {
    const std::string unit = change->metric.unit.empty() ? "" : " [" + change->metric.unit + "]";
    TableCell now{.text = shown(change->after), .link = cells_link(*change)};
    if (change->lost > 0) now.spread = fmt::format("undefined on {}", change->lost);
    table.rows.push_back({{change->scenario, change->pipeline, change->metric.metric + unit},
                          {{shown(change->before)},
                           std::move(now),
                           {.text = signed_number(change->difference.mean), .spread = interval(*change)},
                           {shown(change->metric.tolerance)},
                           {effect_text(change->effect)},
                           {std::isfinite(change->q) ? fmt::format("{:.2g}", change->q) : "–"},
                           sample_cell(*change),
                           worst_seed(*change, run)},
                          false});
  }
  shorten(table);
  return table;
}

std::optional<Table> completeness_table(const Comparison& comparison) {
  Table table{"completeness", "Cells", "", {"what", "scenario", "pipeline", "seed", "status"}, {}, {}};
  add_changes(table, "no longer ok", comparison.broken);
  add_cells(table, "missing", comparison.missing, kLargestTable);
  add_changes(table, "not ok", comparison.failing);
  add_changes(table, "ok again", comparison.mended);
  add_cells(table, "new, not compared", comparison.added, kListedNew);
  for (const auto& metric : comparison.absent)
    table.rows.push_back({{"gate without values", metric, "", "", ""}, {}, false});
  if (table.rows.empty()) return std::nullopt;
  shorten(table);
  return table;
}

std::vector<Table> comparison_tables(const Comparison& comparison, bool all) {
  std::vector<Table> tables;
  const auto add = [&](const char* id, const char* title, Finding finding, bool gates_only, const char* caption) {
    auto changes = changes_with(comparison, finding, gates_only);
    if (std::string_view(id) == "watched") std::erase_if(changes, [](const auto* change) { return change->gate; });
    Table table = change_table(id, title, changes, comparison.after);
    if (table.rows.empty()) return;
    table.caption = caption + (table.caption.empty() ? "" : " " + table.caption);
    tables.push_back(std::move(table));
  };
  add("worse", "What became worse", Finding::worse, true,
      "The pipeline with the largest difference in tolerances comes first. Differences are now − before, with their 95 "
      "% "
      "intervals, over equal seeds or, of a recorded log, over its scans. The effect is the mean difference over its "
      "standard deviation; q is the share of false alarms among all gates that are as certain (Benjamini–Hochberg).");
  add("watched", "Watched metrics that became worse", Finding::worse, false, "They are not gates and fail nothing.");
  if (auto cells = completeness_table(comparison)) tables.push_back(std::move(*cells));
  add("uncertain", "Changed by more than the tolerance, but not on enough seeds to be certain", Finding::uncertain,
      true, "More seeds, or a longer log, would tell.");
  add("better", "What became better", Finding::better, false, "");
  if (!all) return tables;
  add("changed", "Changed, of metrics without a better direction", Finding::changed, false, "");
  add("within", "Changed within the tolerance", Finding::within, false, "");
  add("same", "Equal to the bit", Finding::same, false, "");
  return tables;
}

Document comparison_document(const Comparison& comparison, bool all) {
  Document document{"", {Paragraph{{bold(plain_line(verdict_sentence(comparison), 2000))}}}};
  BulletList differing;
  for (const auto& difference : comparison.differing) differing.items.emplace_back(plain_line(difference));
  if (!differing.items.empty()) {
    document.blocks.push_back(Paragraph{"What differs:"});
    document.blocks.push_back(std::move(differing));
  }
  for (auto& table : comparison_tables(comparison, all)) document.blocks.push_back(std::move(table));
  return document;
}

}  // namespace scanbench::results
