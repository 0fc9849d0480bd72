// Counts the returns of a run along the walls that they come from.
#include "metrics/walls/visible_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/index.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kVisibilityBin = 0.10;

}  // namespace

bool knows_walls(const MetricInput& input) {
  if (input.truth == nullptr || input.truth->walls.empty()) return false;
  return input.truth->wall_ids.empty() || has_beam_truth(input);
}

std::vector<std::vector<Interval>> visible_parts(const MetricInput& input, const Surfaces& surfaces,
                                                 double hits_per_m) {
  SCANBENCH_ASSERT(knows_walls(input));
  const Truth& truth = *input.truth;
  const std::size_t count = surfaces.segments.size();
  std::vector<std::vector<Interval>> visible(count);
  if (truth.wall_ids.empty()) {  // lines without scans: every part counts as seen
    for (std::size_t s = 0; s < count; ++s) visible[s] = {{0.0, surfaces.segments[s].length()}};
    return visible;
  }
  std::vector<std::vector<int>> hits(count);
  for (std::size_t s = 0; s < count; ++s)
    hits[s].resize(std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(surfaces.segments[s].length() / kVisibilityBin - 1e-9))));
  for (std::size_t f = 0; f < input.observed.frames.size(); ++f) {
    const Scan scan = input.observed.scan(f);
    const auto beams = as_index(scan.beams());
    for (std::size_t i = 0; i < beams; ++i) {
      const std::int32_t wall = truth.wall_ids[f * beams + i];
      if (wall < 0 || !scan.valid(static_cast<int>(i))) continue;
      const std::size_t s = as_index(surfaces.of_wall[as_index(wall)]);
      const Segment& segment = surfaces.segments[s];
      const Vec2 p = truth.world_from_sensor[f] *
                     Vec2(truth.ranges[f * beams + i] * scan.sensor.geometry.direction(static_cast<int>(i)));
      if (!(segment.length() > 0)) continue;
      const double share = segment.direction().dot(p - segment.a) / segment.length();
      const auto bins = static_cast<double>(hits[s].size());
      ++hits[s][static_cast<std::size_t>(std::clamp(share * bins, 0.0, bins - 1))];
    }
  }
  for (std::size_t s = 0; s < count; ++s) {
    const double width = surfaces.segments[s].length() / static_cast<double>(hits[s].size());
    for (std::size_t b = 0; b < hits[s].size(); ++b)
      if (hits[s][b] > 0 && hits[s][b] >= hits_per_m * width - 1e-9)
        visible[s].push_back({static_cast<double>(b) * width, static_cast<double>(b + 1) * width});
    visible[s] = unite(std::move(visible[s]), 1e-9);
  }
  return visible;
}

}  // namespace scanbench::metrics
