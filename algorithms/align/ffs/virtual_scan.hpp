// The virtual scan: points on hypothetical lines and rectangles.
#pragma once

#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align::ffs {

/// A virtual scan (section 4.3): points that attract others and do not move.
struct VirtualScan {
  std::vector<Vec2> points;
  std::vector<Vec2> directions;
  std::vector<double> weights;
  std::vector<int> side;  ///< of a rectangle: 4 times its number plus that of the side; -1 for a line
};

}  // namespace scanbench::align::ffs
