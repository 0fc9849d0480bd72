// Index of the lines of many scans in a uniform grid. It finds the lines to which a reading may belong.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench::align {

/// A line as its scan saw it, with free space on the left of its direction.
struct PlacedLine {
  Vec2 start;
  Vec2 direction;  ///< unit
  double length;
  int scan;

  /// Oriented distance [m]: positive in the free space before the line.
  double before(const Vec2& p) const { return cross(direction, p - start); }
  /// Coordinate of p's projection [m]: 0 at the start, `length` at the end.
  double along(const Vec2& p) const { return direction.dot(p - start); }
};

/// A return placed in the world.
struct Sighting {
  Vec2 point;
  Vec2 sensor;                  ///< position of the sensor
  Vec2 surface = Vec2::Zero();  ///< unit direction of the surface that was hit, free space on its left; zero if unknown
};

/// Conditions under which a reading may belong to a line.
struct PartnerRules {
  double gate_m;       ///< largest |oriented distance|
  double margin_m;     ///< enlarges the extent of the line at both ends
  double min_aligned;  ///< smallest cosine of the angle between surface and line, if the surface is known
};

/// True if the reading is within gate and extent, seen from the free side by a beam towards the line, and aligned with
/// it.
inline bool may_belong(const Sighting& seen, const PlacedLine& line, const PartnerRules& rules) {
  const double distance = line.before(seen.point);
  if (!(std::abs(distance) <= rules.gate_m)) return false;
  const double along = line.along(seen.point);
  if (along < -rules.margin_m || along > line.length + rules.margin_m) return false;
  const double sensor = line.before(seen.sensor);
  if (!(sensor > 0 && sensor > distance)) return false;
  return seen.surface.isZero(0.0) || seen.surface.dot(line.direction) >= rules.min_aligned;
}

class LineGrid {
 public:
  /// For queries with at most the gate and the margin of `widest`. The cell size grows with `longest_m`, the length of
  /// the longest line, so that a line covers at most about ten thousand cells.
  LineGrid(const PartnerRules& widest, double longest_m);

  /// Adds the lines of a scan, placed in the world. Scans must be added in ascending order. Lines that are not finite,
  /// have no length or are more than 1e9 m from the origin are skipped.
  void add(int scan, const Pose2& world_from_sensor, std::span<const Segment> lines);

  /// Calls visit(line, oriented distance) with the nearest line of each scan to which the reading may belong, in
  /// ascending order of scans. Of equally near lines the first is taken.
  template <class Visit>
  void for_each_nearest(const Sighting& seen, const PartnerRules& rules, Visit&& visit) const {
    if (!in_range(seen.point)) return;
    const auto found = cells_.find(key_of(cell_of(seen.point.x()), cell_of(seen.point.y())));
    if (found == cells_.end()) return;
    const PlacedLine* best = nullptr;
    double distance = 0.0;
    for (const PlacedLine& line : found->second) {
      if (best != nullptr && best->scan != line.scan) visit(*std::exchange(best, nullptr), distance);
      if (!may_belong(seen, line, rules)) continue;
      const double d = line.before(seen.point);
      if (best != nullptr && std::abs(d) >= std::abs(distance)) continue;
      best = &line;
      distance = d;
    }
    if (best != nullptr) visit(*best, distance);
  }

 private:
  static bool in_range(const Vec2& p) { return p.cwiseAbs().maxCoeff() <= 1e9 && p.allFinite(); }
  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v * inverse_cell_)); }
  // Each pair of cell numbers below 2^31 has a key of its own.
  static std::int64_t key_of(std::int64_t ix, std::int64_t iy) { return iy * (std::int64_t{1} << 32) + ix; }
  void add(const PlacedLine& line);

  double across_m_;
  double along_m_;
  double inverse_cell_;
  std::unordered_map<std::int64_t, std::vector<PlacedLine>> cells_;
};

}  // namespace scanbench::align
