// Values of metrics for the figures of statistics.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/figure.hpp"

namespace scanbench::render {

/// "f1", "raster_chamfer [m]": the label of an axis.
std::string metric_label(const FigureInput& input, const std::string& metric);

/// The mean over the seeds of a pipeline and its interval; none if it has no finite value.
std::optional<MeanBand> band_of(const MeasuredPipeline& measured, const std::string& metric);

/// A value as a cost, lower is better; none for a metric of which no value is better.
std::optional<double> cost_of(const FigureInput& input, const std::string& metric, double value);

/// "no pipeline has a value of the metric f1 for the subject all".
std::string no_value_of(const std::string& metric);

/// The most values that one pipeline has of a metric: the number of seeds.
std::size_t most_seeds(const FigureInput& input, const std::string& metric);

/// Pipelines that differ in one parameter only, in the order of its values.
struct VariedPipelines {
  std::string name;  ///< the common beginning of their names
  std::vector<std::pair<double, const MeasuredPipeline*>> members;
};

/// Groups of two pipelines or more that differ in `parameter` ("extract.threshold_m") alone and have a value of each
/// of these metrics, in the order of their first pipelines.
std::vector<VariedPipelines> varied_pipelines(const std::string& parameter, const std::vector<MeasuredPipeline>& all,
                                              const std::vector<std::string>& metrics);

/// "extract.threshold_m [m]": the parameter with its unit.
std::string parameter_label(const std::string& parameter, const std::vector<MeasuredPipeline>& all);

}  // namespace scanbench::render
