// The three correlations of a scan with the navigation map: segments with segments, points with segments, points with
// points (Siadat et al. 1997, section 7).
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "algorithms/map/parts/registration.hpp"
#include "algorithms/map/parts/scan_segments.hpp"

namespace scanbench::mapping::navigation {

struct SegmentMatchRule {
  double angle_rad = 0.175;    ///< largest difference of direction
  double least_overlap = 0.5;  ///< of the shorter one's length
};

/// Segment-segment: every scan segment with the nearest map segment that agrees in direction, overlaps it and is within
/// the gate at the scan segment's midpoint. A pair is two points on the map's line, length / sqrt(12) on either side of
/// the midpoint: their squared distances are the mean over the whole segment, so that one step solves for rotation and
/// translation together. Weight: the segment's length.
std::vector<PointOnLine> segment_segment_pairs(const std::vector<ScanSegment>& scan, std::span<const Segment> map,
                                               const Pose2& map_from_sensor, double gate_m,
                                               const SegmentMatchRule& rule);

/// Segment-point: every return with the map segment of the smallest oriented distance within the gate, among those
/// whose extent, enlarged by 0.2 m, contains its projection and whose free side the beam comes from. Weight 1.
std::vector<PointOnLine> segment_point_pairs(std::span<const Vec2> points, std::span<const Segment> map,
                                             const Pose2& map_from_sensor, double gate_m);

/// Points of earlier scans, the first one in each cell of a grid.
class PointMap {
 public:
  /// `cell_m` > 0.
  explicit PointMap(double cell_m) : cell_m_(cell_m) {}
  void add(std::span<const Vec2> points);
  /// The nearest point within `gate_m`, until points are added; nullptr if there is none.
  const Vec2* nearest(const Vec2& p, double gate_m) const;

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  std::int64_t cell_of(double x, double size) const;

  double cell_m_;
  std::unordered_set<Key, Hash> taken_;                        ///< cells with a point
  std::unordered_map<Key, std::vector<Vec2>, Hash> by_block_;  ///< points by blocks of half a metre
};

/// Point-point: every return with the nearest point of the map within the gate, as two lines through it, along x and y.
/// Such pairs seem to determine every motion, even along a corridor. Weight 1/2 each.
std::vector<PointOnLine> point_point_pairs(std::span<const Vec2> points, const PointMap& map,
                                           const Pose2& map_from_sensor, double gate_m);

}  // namespace scanbench::mapping::navigation
