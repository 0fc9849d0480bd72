// Reads metrics.csv of the cells, and the descriptions of the metrics.
#include "harness/results/figures/figure_input/measured.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/results/analysis/gates.hpp"
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
  return {.unit = metric.unit, .best = best, .target = metric.target, .tolerance = metric.tolerance};
}

render::MeasuredPipeline measured_pipeline(const runs::RunStore& store, const study::Scenario& scenario,
                                           const study::PipelineSpec& pipeline,
                                           const std::map<std::string, metrics::MetricDescription>& descriptions) {
  render::MeasuredPipeline measured{.pipeline = pipeline.name, .slots = {}, .units = {}, .metrics = {}};
  for (const auto& slot : pipeline.slots) {
    measured.slots[slot.kind + " " + slot.module] = slot.params;
    for (const auto& spec : study::entry_of(slot).params) measured.units[slot.kind + "." + spec.name] = spec.unit;
  }
  for (std::size_t s = 0; s < scenario.seeds.size(); ++s)
    for (const auto& row : store.metrics({scenario.name, pipeline.name, scenario.seeds[s]})) {
      if (row.subject != "all") continue;
      measured.by_seed.try_emplace(row.metric, scenario.seeds.size(), kNaN).first->second[s] = row.value;
      if (std::isfinite(row.value)) measured.metrics[row.metric].push_back(row.value);
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

std::map<std::string, render::MetricLook> metric_looks() {
  std::map<std::string, render::MetricLook> looks;
  for (const auto& [name, description] : metric_descriptions()) looks[name] = look_of(description);
  return looks;
}

}  // namespace scanbench::results
