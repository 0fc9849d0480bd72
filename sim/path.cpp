// Computes arc lengths along a polyline with + - * / and sqrt only, because positions enter recordings, whose bytes
// must not depend on the machine.
#include "sim/path.hpp"

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"

namespace scanbench::sim {

double path_length(std::span<const Vec2> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

PathPoint point_on_path(std::span<const Vec2> path, double arc_length_m) {
  SCANBENCH_ASSERT(!path.empty());
  PathPoint point{path.front(), {1.0, 0.0}};
  double left = std::max(arc_length_m, 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 step = path[i] - path[i - 1];
    const double length = step.norm();
    if (length == 0) continue;
    point.direction = step / length;
    if (left <= length) {
      point.position = path[i - 1] + (left / length) * step;
      return point;
    }
    left -= length;
    point.position = path[i];
  }
  return point;
}

}  // namespace scanbench::sim
