// Reads metrics.csv of the cells, and the descriptions of the metrics.
#include "harness/results/figures/figure_input/measured.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/special_values.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/method_ranking.hpp"
#include "harness/results/analysis/shared_best.hpp"
#include "harness/study/catalog/find_module.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {
namespace {

render::MetricLook look_of(const metrics::MetricDescription& metric) {
  using Best = render::MetricLook::Best;
  Best best = Best::none;
  switch (metric.direction) {
    case metrics::Direction::lower_is_better:
      best = Best::lowest;
      break;
    case metrics::Direction::higher_is_better:
      best = Best::highest;
      break;
    case metrics::Direction::target:
      best = Best::target;
      break;
    case metrics::Direction::neither:
      break;
  }
  return {
      .label = metric.label, .unit = metric.unit, .best = best, .target = metric.target, .tolerance = metric.tolerance};
}

render::MeasuredPipeline measured_pipeline(const runs::RunStore& store, const study::Scenario& scenario,
                                           const study::PipelineSpec& pipeline,
                                           const std::map<std::string, metrics::MetricDescription>& descriptions) {
  render::MeasuredPipeline measured{.pipeline = pipeline.name, .slots = {}, .units = {}, .metrics = {}};
  for (const auto& slot : pipeline.slots) {
    measured.slots[slot.kind + " " + slot.module] = slot.params;
    for (const auto& spec : study::entry_of(slot).params) measured.units[slot.kind + "." + spec.name] = spec.unit;
  }
  const auto add = [&](const std::string& metric, std::size_t seed, double value) {
    measured.by_seed.try_emplace(metric, scenario.seeds.size(), kNaN).first->second[seed] = value;
    if (std::isfinite(value)) measured.metrics[metric].push_back(value);
  };
  for (std::size_t s = 0; s < scenario.seeds.size(); ++s) {
    const runs::CellKey key{scenario.name, pipeline.name, scenario.seeds[s]};
    const auto rows = store.metrics(key);
    std::set<std::string> names;
    for (const auto& row : rows) names.insert(row.metric);
    for (const std::string& metric : names) add(metric, s, value_in(rows, metric));
    if (const auto seconds = store.is_ok(key) ? store.scan_seconds(key) : std::nullopt)
      add(std::string(render::kScanTime), s, *seconds);
  }
  for (const auto& [metric, values] : measured.metrics) {
    const auto known = descriptions.find(metric);
    const ValueRange range = known == descriptions.end() ? ValueRange::any : range_of(known->second);
    const MeanInterval interval = seed_interval(values, range);
    measured.bands[metric] = {interval.mean, interval.low, interval.high, interval.count < kFewestForInterval};
  }
  return measured;
}

}  // namespace

std::vector<render::MeasuredPipeline> measured_pipelines(const runs::RunStore& store, const study::Scenario& scenario) {
  const auto descriptions = metric_descriptions();
  std::vector<render::MeasuredPipeline> all;
  all.reserve(scenario.pipelines.size());
  for (const auto& pipeline : scenario.pipelines)
    all.push_back(measured_pipeline(store, scenario, pipeline, descriptions));
  return all;
}

std::string ranked_metric(const std::vector<render::MeasuredPipeline>& pipelines) {
  std::string best;
  std::ptrdiff_t most = 0;
  for (const std::string_view metric : quality_metrics()) {
    const std::string name(metric);
    const auto with = std::ranges::count_if(pipelines, [&](const auto& p) { return p.bands.contains(name); });
    if (with > most) most = with, best = name;
  }
  return best;
}

std::map<std::string, render::MetricLook> metric_looks() {
  std::map<std::string, render::MetricLook> looks;
  for (const auto& [name, description] : metric_descriptions()) looks[name] = look_of(description);
  looks[std::string(render::kScanTime)] = {
      .label = "CPU time of one scan", .unit = "s", .best = render::MetricLook::Best::lowest};
  return looks;
}

}  // namespace scanbench::results
