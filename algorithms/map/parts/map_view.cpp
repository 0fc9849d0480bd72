// Casts the beams of a sensor at the lines of a map.
#include "algorithms/map/parts/map_view.hpp"

#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::mapping {
namespace {

/// Distance along the unit vector u from the origin to the wall; +inf if it is not met or seen from behind.
double range_to(const Segment& wall, const Vec2& u) {
  const Vec2 d = wall.b - wall.a;
  const double det = cross(u, d);
  if (!(det > 0)) return kInf;  // the free side is on the left: beams that see it cross from left to right of d
  const double range = cross(wall.a, d) / det;
  const double at = cross(wall.a, u) / det;
  return range > 0 && at >= 0 && at <= 1 ? range : kInf;
}

}  // namespace

MapView view_of(std::span<const Segment> walls, const Pose2& map_from_sensor, const SensorModel& sensor) {
  const Pose2 sensor_from_map = map_from_sensor.inverse();
  std::vector<Segment> seen;
  for (const Segment& wall : walls) seen.push_back(sensor_from_map * wall);
  const int beams = sensor.geometry.beams();
  MapView view;
  view.ranges.assign(as_index(beams), kInf);
  view.lines.labels.assign(as_index(beams), -1);
  std::vector<int> wall_of(as_index(beams), -1);
  for (int i = 0; i < beams; ++i) {
    const Vec2 u = sensor.geometry.direction(i);
    for (std::size_t w = 0; w < seen.size(); ++w)
      if (const double range = range_to(seen[w], u); range < view.ranges[as_index(i)]) {
        view.ranges[as_index(i)] = range;
        wall_of[as_index(i)] = static_cast<int>(w);
      }
  }
  const auto point = [&](int beam) { return Vec2(view.ranges[as_index(beam)] * sensor.geometry.direction(beam)); };
  for (int first = 0; first < beams;) {
    int end = first + 1;
    while (end < beams && wall_of[as_index(end)] == wall_of[as_index(first)]) ++end;
    if (wall_of[as_index(first)] >= 0 && end - first >= 2) {
      for (int i = first; i < end; ++i) view.lines.labels[as_index(i)] = static_cast<int>(view.lines.lines.size());
      const Segment s = seen_from_origin(point(first), point(end - 1));
      view.lines.lines.push_back({.segment = s,
                                  .line = line_through(s.a, s.b),
                                  .covariance = {},
                                  .first_beam = first,
                                  .last_beam = end - 1,
                                  .points = end - first});
    }
    first = end;
  }
  return view;
}

}  // namespace scanbench::mapping
