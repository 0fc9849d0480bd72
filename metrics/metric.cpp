// Checks of a metric's input.
#include "metrics/metric.hpp"

#include "core/index.hpp"

namespace scanbench::metrics {

bool has_beam_truth(const MetricInput& input) {
  if (input.truth == nullptr) return false;
  const std::size_t frames = input.observed.frames.size();
  const std::size_t beams = frames * as_index(input.observed.sensor.geometry.beams());
  return input.truth->world_from_sensor.size() == frames && input.truth->wall_ids.size() == beams &&
         input.truth->ranges.size() == beams && input.result.lines.size() == frames;
}

}  // namespace scanbench::metrics
