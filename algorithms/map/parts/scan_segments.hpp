// The lines of a scan that mappers use.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace scanbench::mapping {

/// A line of a scan, sensor frame, with the sensor on its left.
struct ScanSegment {
  Segment segment;
  int points = 0;
  int line = 0;  ///< index in ScanLines
};

/// The finite lines of at least `min_length_m`, of positive length, whose ends are within 1e6 m, in their order.
std::vector<ScanSegment> scan_segments(const Observation& observation, double min_length_m);

/// Sum of their lengths, and the median distance of their ends from the sensor (1 m for none).
double total_length(const std::vector<ScanSegment>& segments);
double lever_of(const std::vector<ScanSegment>& segments);

/// The segments at a pose.
std::vector<Segment> placed_at(const Pose2& map_from_sensor, const std::vector<ScanSegment>& segments);

}  // namespace scanbench::mapping
