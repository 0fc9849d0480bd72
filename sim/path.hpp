// Places along a polyline by arc length: what waypoint trajectories and moving bodies have in common.
#pragma once

#include <span>

#include "core/geometry.hpp"

namespace scanbench::sim {

struct PathPoint {
  Vec2 position = Vec2::Zero();
  Vec2 direction{1.0, 0.0};  ///< unit tangent of the piece it lies on; (1, 0) for a path without length
};

/// Metres; 0 for fewer than two points.
double path_length(std::span<const Vec2> path);

/// The place after `arc_length_m`, clamped to the path. A vertex belongs to the piece that ends there. Throws
/// InternalError for an empty path.
PathPoint point_on_path(std::span<const Vec2> path, double arc_length_m);

}  // namespace scanbench::sim
