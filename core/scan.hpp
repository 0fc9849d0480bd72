// Scans and the lines found in them: input and output of a line extractor.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"
#include "core/index.hpp"
#include "core/sensor_model.hpp"
#include "core/special_values.hpp"

namespace scanbench {

/// A view of one scan: the sensor's data sheet and one range in metres per beam. Special values as in ROS REP-117: +inf
/// nothing in range, -inf too close, NaN faulty.
struct Scan {
  const SensorModel& sensor;
  std::span<const double> ranges;
  double stamp_s = 0.0;

  int beams() const { return static_cast<int>(ranges.size()); }
  /// True for a return: a range that is finite and positive. Range limits were applied when the scan was made or read.
  bool valid(int beam) const {
    const double r = ranges[as_index(beam)];
    return r > 0 && r < kInf;
  }
  /// Cartesian point of a valid beam, sensor frame.
  Vec2 point(int beam) const { return ranges[as_index(beam)] * sensor.geometry.direction(beam); }
};

/// The valid returns of a scan in beam order: points[k] came from beam beams[k]. A missing beam shows as a gap in
/// beams.
struct ScanPoints {
  std::vector<int> beams;
  std::vector<Vec2> points;
  std::size_t size() const { return points.size(); }
};
ScanPoints valid_points(const Scan& scan);

/// A line found in one scan, sensor frame.
struct LineFeature {
  Segment segment;  ///< end points: projections of the first and last support point on the line
  PolarLine line;
  /// Of (offset of the line at the segment's midpoint [m], angle [rad]); absent: not estimated.
  std::optional<Eigen::Matrix2d> covariance;
  int first_beam = -1;
  int last_beam = -1;  ///< inclusive; labels say which beams in between belong to the line
  int points = 0;      ///< support points
  double rms_m = 0.0;  ///< root mean square orthogonal residual of the support
};

/// Lines in scan order of their first beam, and for every beam the index of the line that it supports, -1 for none.
/// labels.size() == scan.beams().
struct ScanLines {
  std::vector<LineFeature> lines;
  std::vector<int> labels;
};

struct Frame {
  double stamp_s = 0.0;
  std::vector<double> ranges;
  Pose2 odom_from_sensor;
  std::vector<Segment> lines{};  ///< given instead of ranges, sensor frame
};

/// Everything that an algorithm may see of a recording.
struct ScanSet {
  SensorModel sensor;
  std::vector<Frame> frames;

  Scan scan(std::size_t frame) const { return {sensor, frames[frame].ranges, frames[frame].stamp_s}; }
  /// True if the frames have lines instead of ranges: there is nothing to extract.
  bool has_given_lines() const {
    return std::ranges::any_of(frames, [](const Frame& frame) { return !frame.lines.empty(); });
  }
};

}  // namespace scanbench
