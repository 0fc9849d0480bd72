// Makes the chart of accuracy against time of a benchmark, and the list of worst cells.
#include "harness/results/pages/benchmark_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/results/analysis/run_results.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/document/scan_sketch.hpp"
#include "harness/results/document/scatter_chart.hpp"
#include "harness/results/figures/worst_scans.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {
namespace {

const study::BenchmarkColumn* column_of(const study::BenchmarkSubject& subject, const std::string& metric) {
  const auto found = std::ranges::find(subject.columns, metric, &study::BenchmarkColumn::metric);
  return found == subject.columns.end() ? nullptr : &*found;
}

/// True if no other pipeline is both as good and as fast.
bool is_on_front(const std::vector<RankedPipeline>& ranking, const RankedPipeline& one,
                 const metrics::MetricDescription& quality, const std::string& time) {
  const auto better_in_one = [&](const RankedPipeline& other) {
    const double cost = metrics::cost(quality, other.values.at(quality.metric).mean);
    const double own = metrics::cost(quality, one.values.at(quality.metric).mean);
    const double seconds = other.values.at(time).mean, own_seconds = one.values.at(time).mean;
    return cost <= own && seconds <= own_seconds && (cost < own || seconds < own_seconds);
  };
  return std::ranges::none_of(ranking, better_in_one);
}

/// The worst value of the rank's metric of a pipeline, over all cells.
struct WorstCell {
  runs::CellKey key;
  double value = 0.0;
};

std::map<std::string, WorstCell> worst_cells(const ReportInput& input, const metrics::MetricDescription& quality) {
  std::map<std::string, WorstCell> worst;
  for (const runs::SummaryRow& row : input.rows) {
    if (row.metric != quality.metric || row.subject != "all" || !std::isfinite(row.value)) continue;
    const auto [place, is_new] = worst.try_emplace(row.pipeline);
    if (is_new || metrics::better(quality, place->second.value, row.value))
      place->second = {{row.scenario, row.pipeline, row.seed}, row.value};
  }
  return worst;
}

std::string folder_of(const ReportInput& input, const runs::CellKey& key) {
  for (const CellLine& cell : input.cells)
    if (cell.scenario == key.scenario && cell.pipeline == key.pipeline && cell.seed == key.seed) return cell.folder;
  return "";
}

/// The worst scans, drawn small.
Blocks scan_blocks(const std::vector<PipelineWorst>& worst) {
  BlockGroup sketches{"scans", {}};
  for (const auto& [pipeline, scans] : worst)
    for (const WorstScan& scan : scans)
      sketches.blocks.push_back(
          Picture{.alt = fmt::format("the worst scan of {}", pipeline),
                  .caption = {bold(pipeline),
                              fmt::format(", scan {}: F1 {:.2f}, {} right, {} false, {} missed, {} split", scan.frame,
                                          scan.f1, scan.found, scan.false_lines, scan.missed, scan.split)},
                  .drawing = scan.sketch});
  if (sketches.blocks.empty()) return {};
  return {Paragraph{"The worst scan of each of these cells:"}, Markup{scan_sketch_key()}, std::move(sketches)};
}

}  // namespace

Blocks accuracy_blocks(const ReportInput& input) {
  const study::BenchmarkSubject& subject = input.benchmark.value().subject();
  const study::BenchmarkColumn& rank = subject.rank_column();
  const study::BenchmarkColumn* time = column_of(subject, subject.time_metric);
  if (time == nullptr) return {};
  ScatterChart chart{time->head, rank.head, {}};
  for (const RankedPipeline& ranked : input.ranking)
    chart.points.push_back({time->scale * ranked.values.at(time->metric).mean,
                            rank.scale * ranked.values.at(rank.metric).mean, ranked.name,
                            is_on_front(input.ranking, ranked, rank.description(), time->metric)});
  const std::string drawing = scatter_chart(chart);
  if (drawing.empty()) return {};
  return {Picture{.alt = rank.name() + " against time",
                  .caption = fmt::format("{} against time, over all conditions. ● on the dashed line: no other {} is "
                                         "both as good and as fast. ○: another is.",
                                         rank.name(), subject.noun),
                  .drawing = drawing}};
}

Blocks worst_blocks(const ReportInput& input) {
  const study::BenchmarkSubject& subject = input.benchmark.value().subject();
  const study::BenchmarkColumn& rank = subject.rank_column();
  const auto worst = worst_cells(input, rank.description());
  if (worst.empty()) return {};
  const std::string run = shell_word(input.run.lexically_normal().generic_string());
  Table table{"worst", "", "", {subject.noun, "condition"}, {{"", rank.head}, {"", "seed"}}, {}};
  for (const RankedPipeline& ranked : input.ranking) {
    const auto cell = worst.find(ranked.name);
    if (cell == worst.end()) continue;
    const auto& [key, value] = cell->second;
    TableCell seed{.text = std::to_string(key.seed), .link = folder_of(input, key)};
    if (subject.shows_example)
      seed.hint = fmt::format("scanbench show {} --scenario {} --pipeline {} --seed {}", run, key.scenario,
                              key.pipeline, key.seed);
    table.rows.push_back(
        {{ranked.name, key.scenario}, {{fmt::format("{:.{}f}", rank.scale * value, rank.decimals)}, std::move(seed)}});
  }
  Blocks blocks{Paragraph{fmt::format("The cell of each {} with the worst {}. The pointer on a seed shows the command "
                                      "that draws its worst scan large.",
                                      subject.noun, rank.name())},
                BlockGroup{"plain", {std::move(table)}}};
  add_blocks(blocks, scan_blocks(input.worst));
  return blocks;
}

std::vector<PipelineWorst> benchmark_worst_scans(const ReportInput& input) {
  const study::BenchmarkSubject& subject = input.benchmark.value().subject();
  if (!subject.shows_example) return {};
  const auto worst = worst_cells(input, subject.rank_column().description());
  RunResults results;  // of these cells alone
  for (const RankedPipeline& ranked : input.ranking)
    if (const auto cell = worst.find(ranked.name); cell != worst.end()) {
      CellResults& added = results.cells.emplace_back();
      added.key = cell->second.key;
      added.status = "ok";
    }
  return worst_scans(input.run, results, 1);
}

}  // namespace scanbench::results
