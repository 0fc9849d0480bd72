// Intersection of a ray with a wall or a circle, in double. Watertight: two walls that share an end point leave no gap.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.hpp"

namespace scanbench::sim {

/// A ray that passes an end of a wall within this distance hits it, so that a ray aimed exactly at a corner hits in
/// spite of rounding: the error from coordinates of 100 km and a rounded direction is smaller.
inline constexpr double kEndToleranceM = 1e-10;

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Range from `origin` along the unit vector `direction` to the wall; +inf if there is no hit. A wall is hit from both
/// sides and at its ends; one seen exactly edge-on is hit at its nearer end; from a point on it the range is 0.
///
/// The test compares the sides of the ray on which the two ends are. Both walls at a corner compute the corner's side
/// from the same numbers, hence with the same sign, so no ray passes between them (the idea of Woop, Benthin & Wald,
/// "Watertight ray/triangle intersection", JCGT 2013).
inline double range_to_wall(const Vec2& origin, const Vec2& direction, const Segment& wall) {
  const Vec2 a = wall.a - origin;
  const Vec2 b = wall.b - origin;
  const double side_a = cross(direction, a);
  const double side_b = cross(direction, b);
  if ((side_a > kEndToleranceM && side_b > kEndToleranceM) || (side_a < -kEndToleranceM && side_b < -kEndToleranceM))
    return kNoHit;
  const double along_a = direction.dot(a);
  const double along_b = direction.dot(b);
  const bool on_a = std::fabs(side_a) <= kEndToleranceM;
  const bool on_b = std::fabs(side_b) <= kEndToleranceM;
  if (on_a && on_b && (along_a < 0) != (along_b < 0)) return 0.0;  // edge-on, from a point of the wall
  double range = kNoHit;
  const auto consider = [&range](double along) {
    if (along >= -kEndToleranceM) range = std::min(range, std::max(along, 0.0));
  };
  if (on_a) consider(along_a);
  if (on_b) consider(along_b);
  if ((side_a < 0) != (side_b < 0)) {
    const double share = std::clamp(side_a / (side_a - side_b), 0.0, 1.0);
    consider(along_a + share * (along_b - along_a));
  }
  return range;
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
