// Values of metrics for the figures of statistics.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/figure.hpp"

namespace scanbench::render {

/// The doc of the parameter `metric`.
inline constexpr std::string_view kRankedMetricDoc =
    "the metric that is shown; empty: the one by which reports rank the pipelines";

/// The metric that a figure shows: `wanted`, else the one by which reports rank; empty if there is none.
std::string chosen_metric(const FigureInput& input, const std::string& wanted);

/// "F1", "Chamfer distance": the words for a metric; its name if it has none.
std::string metric_words(const FigureInput& input, const std::string& metric);

/// An axis of values of a metric.
Axis metric_axis(const FigureInput& input, const std::string& metric);

/// The mean over the seeds of a pipeline and its interval; none if it has no finite value.
std::optional<MeanBand> band_of(const MeasuredPipeline& measured, const std::string& metric);

/// A value as a cost, lower is better; none for a metric of which no value is better.
std::optional<double> cost_of(const FigureInput& input, const std::string& metric, double value);

/// "no pipeline has a value of the metric f1".
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

/// The parameters in which two pipelines with values of these metrics differ alone, by name.
std::vector<std::string> varied_parameters(const std::vector<MeasuredPipeline>& all,
                                           const std::vector<std::string>& metrics);

/// "threshold": the words of a parameter's name, "extract.threshold_m", without its slot and its unit.
std::string parameter_words(const std::string& parameter, const std::vector<MeasuredPipeline>& all);

/// "threshold [m]": the same with the unit.
std::string parameter_with_unit(const std::string& parameter, const std::vector<MeasuredPipeline>& all);

/// An axis of values of a parameter.
Axis parameter_axis(const std::string& parameter, const std::vector<MeasuredPipeline>& all);

}  // namespace scanbench::render
