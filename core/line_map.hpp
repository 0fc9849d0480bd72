// Lines in the world frame.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// A line of a map, or a scan's line in the world frame, as input to a merger.
struct MapLine {
  Segment segment;
  /// Of (lateral offset [m], angle [rad]) at the midpoint; zero: unknown.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  int members = 1;  ///< scan lines merged into it
  int points = 0;   ///< scan points that support those
};

struct LineMap {
  std::vector<MapLine> lines;
};

}  // namespace scanbench
