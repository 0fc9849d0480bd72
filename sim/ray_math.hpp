// Intersection of a ray with a wall or a circle, in double. Watertight: two walls that share an end point leave no gap.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim {

/// Range from `origin` along the unit vector `direction` to the wall; +inf if there is no hit. See range_along_wall().
inline double range_to_wall(const Vec2& origin, const Vec2& direction, const Segment& wall) {
  const Vec2 a = wall.a - origin;
  const Vec2 b = wall.b - origin;
  return range_along_wall(a.x(), a.y(), b.x(), b.y(), direction.x(), direction.y());
}

/// |cos| of the angle between the ray and the wall's normal: 1 head-on, 0 edge-on.
inline double cos_incidence_on_wall(const Vec2& direction, const Segment& wall) {
  return std::min(1.0, std::fabs(cross(direction, wall.direction())));
}

/// Range to a circle; 0 from inside, because a round body is solid; +inf if there is no hit.
inline double range_to_circle(const Vec2& origin, const Vec2& direction, const Vec2& center, double radius) {
  const Vec2 c = center - origin;
  const double miss = std::fabs(cross(direction, c));
  if (miss > radius) return kNoHit;
  const double half_chord = std::sqrt((radius - miss) * (radius + miss));
  const double middle = direction.dot(c);
  if (middle + half_chord < 0) return kNoHit;
  return std::max(0.0, middle - half_chord);
}

/// cos of the angle between the ray and the circle's normal where it enters.
inline double cos_incidence_on_circle(const Vec2& origin, const Vec2& direction, const Vec2& center, double radius) {
  const double miss = std::min(std::fabs(cross(direction, Vec2(center - origin))), radius);
  return std::sqrt((radius - miss) * (radius + miss)) / radius;
}

}  // namespace scanbench::sim
