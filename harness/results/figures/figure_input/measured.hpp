// The metrics of a run's cells, as figures read them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/runs/store/run_store.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "render/figure.hpp"

namespace scanbench::results {

/// The values of metrics.csv of all cells of a scenario, and the time of a scan, by pipeline. Throws ConfigError for a
/// damaged file.
std::vector<render::MeasuredPipeline> measured_pipelines(const runs::RunStore& store, const study::Scenario& scenario);

/// The metric by which reports rank these pipelines: of quality_metrics(), the first that most of them have; empty if
/// none has any.
std::string ranked_metric(const std::vector<render::MeasuredPipeline>& pipelines);

/// The descriptions of the metrics of all registered families, by name.
std::map<std::string, render::MetricLook> metric_looks();

}  // namespace scanbench::results
