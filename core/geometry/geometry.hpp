// Points, segments and infinite lines of the plane. Metres and radians.
#pragma once

#include <Eigen/Core>

#include "core/geometry/angles.hpp"

namespace scanbench {

using Vec2 = Eigen::Vector2d;

/// z component of the cross product: positive when b points to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// a rotated by +90 degrees.
inline Vec2 perpendicular(const Vec2& a) {
  return {-a.y(), a.x()};
}

/// A segment a -> b with the free space, and the sensor, on its left. Counter-clockwise beams give this order when a is
/// the end seen first.
struct Segment {
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();

  double length() const { return (b - a).norm(); }
  Vec2 midpoint() const { return 0.5 * (a + b); }
  /// Unit vector from a to b; zero for a segment without length.
  Vec2 direction() const {
    const Vec2 d = b - a;
    const double n = d.norm();
    return n > 0 ? Vec2(d / n) : Vec2(Vec2::Zero());
  }
  /// Undirected direction in [0, pi).
  double direction_angle() const;
  bool operator==(const Segment&) const = default;
};

/// The segment between two points with the origin of their frame, the sensor, on its left. Points in line with the
/// origin keep their order.
Segment seen_from_origin(const Vec2& p, const Vec2& q);

/// Angle between the undirected directions of two segments, in [0, pi/2].
double angle_between(const Segment& a, const Segment& b);

/// Distance from p to the nearest point of s (of the segment, not of its line). A segment without length is its point.
double distance(const Vec2& p, const Segment& s);

/// The infinite line x cos(alpha) + y sin(alpha) = rho, rho >= 0, alpha in (-pi, pi]. Never subtract the fields of two
/// lines: (rho, alpha) and (-rho, alpha + pi) are the same line, so near rho = 0 equal lines can have very different
/// fields. Use line_difference().
struct PolarLine {
  double rho = 0.0;
  double alpha = 0.0;

  Vec2 normal() const;
  /// rho - x cos(alpha) - y sin(alpha): positive on the origin's side.
  double signed_distance(const Vec2& p) const { return rho - normal().dot(p); }
  bool operator==(const PolarLine&) const = default;
};

/// The canonical form of the line with any sign of rho and any alpha: rho >= 0, alpha in (-pi, pi], and for rho == 0
/// alpha in [0, pi).
PolarLine canonical(double rho, double alpha);

/// The canonical line through two different points; alpha = 0 through a if they coincide.
PolarLine line_through(const Vec2& a, const Vec2& b);

/// |delta rho| and |delta alpha| between two lines, with |delta alpha| <= pi/2.
struct LineDifference {
  double rho;
  double alpha;
};
LineDifference line_difference(const PolarLine& a, const PolarLine& b);

}  // namespace scanbench
