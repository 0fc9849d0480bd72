// Points on a polyline by arc length, for waypoint trajectories and moving bodies.
#pragma once

#include <span>

#include "core/geometry/geometry.hpp"

namespace scanbench::sim {

struct PathPoint {
  Vec2 position = Vec2::Zero();
  Vec2 direction{1.0, 0.0};  ///< unit tangent of its piece of the path; (1, 0) for a path without length
};

/// Metres; 0 for fewer than two points.
double path_length(std::span<const Vec2> path);

/// The point after `arc_length_m`, clamped to the path. A vertex belongs to the piece that ends there. Throws
/// InternalError for an empty path.
PathPoint point_on_path(std::span<const Vec2> path, double arc_length_m);

}  // namespace scanbench::sim
