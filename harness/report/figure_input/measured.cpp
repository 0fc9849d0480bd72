// Reads metrics.csv of the cells, and the descriptions of the metrics.
#include "harness/report/figure_input/measured.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "harness/analysis/statistics.hpp"
#include "harness/catalog/find_module.hpp"
#include "harness/store/archived_run.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/summary.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {
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

/// The values over all lines or scans of one pipeline: from metrics.csv of its cells, or from summary.csv of an
/// archived run.
using AddValue = std::function<void(std::size_t seed, const std::string& metric, double value)>;

void add_values(const std::filesystem::path& run, const Scenario& scenario, const std::string& pipeline,
                const std::vector<SummaryRow>& archived, const AddValue& add) {
  std::map<std::uint64_t, std::size_t> places;
  for (std::size_t s = 0; s < scenario.seeds.size(); ++s) places.emplace(scenario.seeds[s], s);
  for (const auto& row : archived) {
    const auto place = places.find(row.seed);
    if (row.scenario == scenario.name && row.pipeline == pipeline && row.subject == "all" && place != places.end())
      add(place->second, row.metric, row.value);
  }
  if (!archived.empty()) return;
  for (std::size_t s = 0; s < scenario.seeds.size(); ++s) {
    const auto cell = cell_path(run, {scenario.name, pipeline, scenario.seeds[s]});
    if (!std::filesystem::exists(cell / kMetricsFile)) continue;
    for (const auto& row : load_metrics(cell))
      if (row.subject == "all") add(s, row.metric, row.value);
  }
}

render::MeasuredPipeline measured_pipeline(const std::filesystem::path& run, const Scenario& scenario,
                                           const PipelineSpec& pipeline, const std::vector<SummaryRow>& archived) {
  render::MeasuredPipeline measured{.pipeline = pipeline.name, .slots = {}, .units = {}, .metrics = {}};
  for (const auto& slot : pipeline.slots) {
    measured.slots[slot.kind + " " + slot.module] = slot.params;
    for (const auto& spec : entry_of(slot).params) measured.units[slot.kind + "." + spec.name] = spec.unit;
  }
  add_values(run, scenario, pipeline.name, archived, [&](std::size_t s, const std::string& metric, double value) {
    measured.by_seed.try_emplace(metric, scenario.seeds.size(), kNaN).first->second[s] = value;
    if (std::isfinite(value)) measured.metrics[metric].push_back(value);
  });
  for (const auto& [metric, values] : measured.metrics) {
    const MeanInterval interval = mean_interval(values);
    measured.bands[metric] = {interval.mean, interval.low, interval.high};
  }
  return measured;
}

}  // namespace

std::vector<render::MeasuredPipeline> measured_pipelines(const std::filesystem::path& run, const Scenario& scenario) {
  std::vector<render::MeasuredPipeline> all;
  std::vector<SummaryRow> archived;
  if (has_archives(run)) archived = load_summary(run / kSummaryFile);
  for (const auto& pipeline : scenario.pipelines) all.push_back(measured_pipeline(run, scenario, pipeline, archived));
  return all;
}

std::map<std::string, render::MetricLook> metric_looks() {
  std::map<std::string, render::MetricLook> looks;
  for (const auto& [name, entry] : Registry<metrics::MetricFamily>::all())
    for (const auto& metric : entry.make({})->describe()) looks[metric.metric] = look_of(metric);
  return looks;
}

}  // namespace scanbench::harness
