// Finds the pairs of the three correlations.
#include "algorithms/map/navigation/correlation.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/interval.hpp"

namespace scanbench::mapping::navigation {
namespace {

constexpr double kMarginM = 0.2;  // A point may project so far beyond the end of a segment.
constexpr double kBlockM = 0.5;   // Blocks of the point map: about the widest gate.

struct LineOf {
  Vec2 normal;
  double offset;
};

LineOf line_of(const Segment& s) {
  const Vec2 normal = perpendicular(s.direction());
  return {normal, normal.dot(s.a)};
}

}  // namespace

std::vector<PointOnLine> segment_segment_pairs(const std::vector<ScanSegment>& scan, std::span<const Segment> map,
                                               const Pose2& map_from_sensor, double gate_m,
                                               const SegmentMatchRule& rule) {
  std::vector<PointOnLine> pairs;
  const double least_cosine = std::cos(rule.angle_rad);
  for (const ScanSegment& line : scan) {
    const Segment placed = map_from_sensor * line.segment;
    const Segment* best = nullptr;
    double nearest = gate_m;
    for (const Segment& wall : map) {
      const Vec2 u = wall.direction();
      if (u.dot(placed.direction()) < least_cosine) continue;
      const double shorter = std::min(wall.length(), placed.length());
      const Interval common = intersection({0.0, wall.length()}, projection(placed, wall.a, u));
      if (common.length() < rule.least_overlap * shorter) continue;
      const double distance = std::abs(cross(u, placed.midpoint() - wall.a));
      if (distance > nearest) continue;
      nearest = distance;
      best = &wall;
    }
    if (best == nullptr) continue;
    const LineOf on = line_of(*best);
    const Vec2 half = line.segment.length() / std::sqrt(12.0) * line.segment.direction();
    for (const double side : {-1.0, 1.0})
      pairs.push_back({line.segment.midpoint() + side * half, on.normal, on.offset, 0.5 * line.segment.length()});
  }
  return pairs;
}

std::vector<PointOnLine> segment_point_pairs(std::span<const Vec2> points, std::span<const Segment> map,
                                             const Pose2& map_from_sensor, double gate_m) {
  std::vector<PointOnLine> pairs;
  const Vec2& sensor = map_from_sensor.translation();
  for (const Vec2& point : points) {
    const Vec2 p = map_from_sensor * point;
    const Segment* best = nullptr;
    double nearest = gate_m;
    for (const Segment& wall : map) {
      const Vec2 u = wall.direction();
      const double before = cross(u, p - wall.a), of_sensor = cross(u, sensor - wall.a);
      if (std::abs(before) > nearest || of_sensor <= 0 || of_sensor <= before) continue;
      const double along = u.dot(p - wall.a);
      if (along < -kMarginM || along > wall.length() + kMarginM) continue;
      nearest = std::abs(before);
      best = &wall;
    }
    if (best == nullptr) continue;
    const LineOf on = line_of(*best);
    pairs.push_back({point, on.normal, on.offset, 1.0});
  }
  return pairs;
}

std::size_t PointMap::Hash::operator()(const Key& key) const {
  return static_cast<std::size_t>(key.first * 73856093 ^ key.second * 19349663);
}

std::int64_t PointMap::cell_of(double x, double size) const {
  return static_cast<std::int64_t>(std::floor(x / size));
}

void PointMap::add(std::span<const Vec2> points) {
  for (const Vec2& p : points)
    if (taken_.emplace(cell_of(p.x(), cell_m_), cell_of(p.y(), cell_m_)).second)
      by_block_[{cell_of(p.x(), kBlockM), cell_of(p.y(), kBlockM)}].push_back(p);
}

const Vec2* PointMap::nearest(const Vec2& p, double gate_m) const {
  const Vec2* best = nullptr;
  double nearest = gate_m;
  for (std::int64_t x = cell_of(p.x() - gate_m, kBlockM); x <= cell_of(p.x() + gate_m, kBlockM); ++x)
    for (std::int64_t y = cell_of(p.y() - gate_m, kBlockM); y <= cell_of(p.y() + gate_m, kBlockM); ++y) {
      const auto block = by_block_.find({x, y});
      if (block == by_block_.end()) continue;
      for (const Vec2& q : block->second)
        if (const double distance = (q - p).norm(); distance <= nearest) {
          nearest = distance;
          best = &q;
        }
    }
  return best;
}

std::vector<PointOnLine> point_point_pairs(std::span<const Vec2> points, const PointMap& map,
                                           const Pose2& map_from_sensor, double gate_m) {
  std::vector<PointOnLine> pairs;
  for (const Vec2& point : points) {
    const Vec2* partner = map.nearest(map_from_sensor * point, gate_m);
    if (partner == nullptr) continue;
    pairs.push_back({point, Vec2(1, 0), partner->x(), 0.5});
    pairs.push_back({point, Vec2(0, 1), partner->y(), 0.5});
  }
  return pairs;
}

}  // namespace scanbench::mapping::navigation
