// The walls of the truth as a scan can show them: collinear walls that touch are one surface.
#pragma once

#include <span>
#include <vector>

#include "core/truth.hpp"

namespace scanbench::metrics {

/// Walls that are on one line and touch or overlap form one surface, because no sensor can see where one of them ends.
/// Collinear walls with a gap between them are two surfaces.
struct Surfaces {
  std::vector<Segment> segments;  ///< hull of its walls, in the order of their first walls
  std::vector<int> of_wall;       ///< per wall the index of its surface
};
Surfaces join_walls(std::span<const Wall> walls);

}  // namespace scanbench::metrics
