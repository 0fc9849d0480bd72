// Lines in the world frame.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry.hpp"

namespace scanbench {

/// A line of a map, or a scan's line placed in the world on its way into one.
struct MapLine {
  Segment segment;
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Zero();  ///< of (lateral offset [m], angle [rad]) at the midpoint; zero: unknown
  int members = 1;              ///< scan lines merged into it
  int points = 0;               ///< scan points behind it
};

struct LineMap {
  std::vector<MapLine> lines;
};

}  // namespace scanbench
