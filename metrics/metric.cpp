// Comparison of values by a metric's direction, and checks of a metric's input.
#include "metrics/metric.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::metrics {

MetricDescription share(MetricDescription metric) {
  metric.is_share = true;
  return metric;
}

double cost(const MetricDescription& metric, double value) {
  switch (metric.direction) {
    case Direction::lower_is_better:
      return value;
    case Direction::higher_is_better:
      return -value;
    case Direction::target:
      return std::fabs(value - metric.target);
    case Direction::neither:
      return kNaN;
  }
  throw InternalError("a direction of a metric without a cost");
}

bool better(const MetricDescription& metric, double a, double b) {
  const double cost_a = cost(metric, a);
  const double cost_b = cost(metric, b);
  return cost_a < cost_b || (!std::isnan(cost_a) && std::isnan(cost_b));
}

bool has_beam_truth(const MetricInput& input) {
  if (input.truth == nullptr) return false;
  const std::size_t frames = input.observed.frames.size();
  const std::size_t beams = frames * as_index(input.observed.sensor.geometry.beams());
  return input.truth->world_from_sensor.size() == frames && input.truth->wall_ids.size() == beams &&
         input.truth->ranges.size() == beams && input.result.lines.size() == frames;
}

}  // namespace scanbench::metrics
