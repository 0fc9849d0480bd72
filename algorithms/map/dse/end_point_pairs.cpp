// Cuts the scan at the map's ends and looks up the nearest line of every end.
#include "algorithms/map/dse/end_point_pairs.hpp"

#include <cmath>

namespace scanbench::mapping::dse {
namespace {

/// The nearest line for an end of a piece; nullptr if none is within the gate.
const Segment* nearest_line(const Vec2& p, const Vec2& along, std::span<const Stroke> map, double gate,
                            const CorrespondenceRule& rule) {
  const Segment* nearest = nullptr;
  double least = gate;
  const double cosine = std::cos(rule.angle_rad);
  for (const Stroke& stroke : map) {
    const Segment& s = stroke.segment;
    const Vec2 u = s.direction();
    const double agreement = u.dot(along);
    if ((rule.same_side ? agreement : std::abs(agreement)) < cosine) continue;
    const double at = u.dot(p - s.a);
    if (at < -rule.extent_m || at > s.length() + rule.extent_m) continue;
    const double distance = std::abs(cross(u, p - s.a));
    if (distance <= least) {
      least = distance;
      nearest = &s;
    }
  }
  return nearest;
}

}  // namespace

std::vector<PointOnLine> end_point_pairs(std::span<const Stroke> scan, std::span<const Stroke> map,
                                         const Pose2& map_from_sensor, double gate_m, const CorrespondenceRule& rule) {
  const Pose2 sensor_from_map = map_from_sensor.inverse();
  std::vector<Vec2> ends = ends_of(map);
  for (Vec2& end : ends) end = sensor_from_map * end;
  std::vector<PointOnLine> pairs;
  for (const Stroke& piece : with_vertices(scan, ends, rule.insertion)) {
    const Vec2 along = map_from_sensor.rotate(piece.segment.direction());
    for (const Vec2& end : {piece.segment.a, piece.segment.b}) {
      const Segment* line = nearest_line(map_from_sensor * end, along, map, gate_m, rule);
      if (line == nullptr) continue;
      const Vec2 normal = perpendicular(line->direction());
      pairs.push_back(
          {.point = end, .normal = normal, .offset_m = normal.dot(line->a), .weight = 0.5 * piece.segment.length()});
    }
  }
  return pairs;
}

}  // namespace scanbench::mapping::dse
