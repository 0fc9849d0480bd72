// The range from a ray's origin to a wall, computed on plain numbers by the one expression that every caster uses.
#pragma once

#include <limits>

namespace scanbench::sim {

/// A ray that passes an end of a wall within this distance hits it, so that a ray aimed exactly at a corner hits in
/// spite of rounding: the error from coordinates of 100 km and a rounded direction is smaller.
inline constexpr double kEndToleranceM = 1e-10;

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Range along the unit vector d from the origin to the wall from a to b; +inf if there is no hit. A wall is hit from
/// both sides and at its ends; one seen exactly edge-on is hit at its nearer end; from a point on it the range is 0.
///
/// The test compares the sides of the ray on which the two ends are. Both walls at a corner compute the corner's side
/// from the same numbers, hence with the same sign, so no ray passes between them (the idea of Woop, Benthin & Wald,
/// "Watertight ray/triangle intersection", JCGT 2013).
///
/// Always inlined: the kernels of sim/lanes/ are compiled for several processors and must not share code.
[[gnu::always_inline]] inline double range_along_wall(double ax, double ay, double bx, double by, double dx,
                                                      double dy) {
  const double side_a = dx * ay - dy * ax;
  const double side_b = dx * by - dy * bx;
  if ((side_a > kEndToleranceM && side_b > kEndToleranceM) || (side_a < -kEndToleranceM && side_b < -kEndToleranceM))
    return kNoHit;
  const double along_a = dx * ax + dy * ay;
  const double along_b = dx * bx + dy * by;
  const bool on_a = side_a >= -kEndToleranceM && side_a <= kEndToleranceM;
  const bool on_b = side_b >= -kEndToleranceM && side_b <= kEndToleranceM;
  if (on_a && on_b && (along_a < 0) != (along_b < 0)) return 0.0;  // edge-on, from a point of the wall
  double range = kNoHit;
  const auto consider = [&range](double along) __attribute__((always_inline)) {
    if (!(along >= -kEndToleranceM)) return;
    const double r = along < 0.0 ? 0.0 : along;
    if (r < range) range = r;
  };
  if (on_a) consider(along_a);
  if (on_b) consider(along_b);
  if ((side_a < 0) != (side_b < 0)) {
    double share = side_a / (side_a - side_b);
    share = share < 0.0 ? 0.0 : (share > 1.0 ? 1.0 : share);
    consider(along_a + share * (along_b - along_a));
  }
  return range;
}

}  // namespace scanbench::sim
