// What a scanner would see of a map: a scan without noise, so that matchers of scans can match a scan with a map.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"

namespace scanbench::mapping {

/// Ranges and lines of a made-up scan.
struct MapView {
  std::vector<double> ranges;
  ScanLines lines;

  /// With the sensor and the stamp of a real scan.
  Scan scan(const Scan& like) const { return {like.sensor, ranges, like.stamp_s}; }
};

/// Every beam of the sensor at `map_from_sensor` meets the nearest of the walls whose free side looks at the sensor,
/// +inf where there is none. A line is a run of at least two beams that meet one wall. O(beams * walls).
MapView view_of(std::span<const Segment> walls, const Pose2& map_from_sensor, const SensorModel& sensor);

}  // namespace scanbench::mapping
