// Finds the true lines of a scan: runs of beams that end on one surface.
#include "metrics/walls/true_lines.hpp"

#include <algorithm>
#include <span>

#include "core/index.hpp"

namespace scanbench::metrics {

std::vector<TrueLine> true_lines(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                                 const TrueLineRule& rule) {
  const Scan scan = input.observed.scan(frame);
  const auto beams = as_index(scan.beams());
  const std::span true_ranges = std::span(input.truth->ranges).subspan(frame * beams, beams);
  const std::span wall_ids = std::span(input.truth->wall_ids).subspan(frame * beams, beams);
  const auto surface = [&](std::size_t i) { return wall_ids[i] < 0 ? -1 : surfaces.of_wall[as_index(wall_ids[i])]; };
  std::vector<TrueLine> lines;
  for (std::size_t begin = 0, end = 0; begin < beams; begin = end) {
    end = begin + 1;
    while (end < beams && surface(end) == surface(begin)) ++end;
    if (surface(begin) < 0) continue;
    TrueLine line{.segment = {}, .surface = surface(begin)};
    for (std::size_t i = begin; i < end; ++i) {
      const int beam = static_cast<int>(i);
      if (!scan.valid(beam)) continue;
      const Vec2 p = true_ranges[i] * scan.sensor.geometry.direction(beam);
      if (line.beams == 0) {
        line.first_beam = beam;
        line.segment.a = p;
      }
      line.last_beam = beam;
      line.segment.b = p;
      ++line.beams;
    }
    const double length = line.segment.length();
    if (line.beams >= std::max(rule.min_beams, 2) && length >= rule.min_length_m && length > 0) lines.push_back(line);
  }
  return lines;
}

}  // namespace scanbench::metrics
