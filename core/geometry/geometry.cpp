// Distances, canonical forms and differences of lines.
#include "core/geometry/geometry.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/portable_math.hpp"

namespace scanbench {

double Segment::direction_angle() const {
  return direction_mod_pi(portable::atan2(b.y() - a.y(), b.x() - a.x()));
}

Segment seen_from_origin(const Vec2& p, const Vec2& q) {
  return cross(p, q) < 0 ? Segment{q, p} : Segment{p, q};
}

double angle_between(const Segment& a, const Segment& b) {
  const Vec2 u = a.direction();
  const Vec2 v = b.direction();
  return std::atan2(std::fabs(cross(u, v)), std::fabs(u.dot(v)));
}

double distance(const Vec2& p, const Segment& s) {
  const Vec2 d = s.b - s.a;
  const double n2 = d.squaredNorm();
  if (n2 == 0) return (p - s.a).norm();
  const double t = std::clamp((p - s.a).dot(d) / n2, 0.0, 1.0);
  return (p - (s.a + t * d)).norm();
}

Vec2 PolarLine::normal() const {
  const auto [s, c] = portable::sincos(alpha);
  return {c, s};
}

PolarLine canonical(double rho, double alpha) {
  double a = wrap_angle(alpha);
  if (rho < 0) {
    rho = -rho;
    a = wrap_angle(a + kPi);
  }
  if (rho == 0) a = direction_mod_pi(a);
  return {rho, a};
}

PolarLine line_through(const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  if (d.squaredNorm() == 0) return canonical(a.x(), 0.0);
  const Vec2 n = perpendicular(d).normalized();
  return canonical(n.dot(a), portable::atan2(n.y(), n.x()));
}

LineDifference line_difference(const PolarLine& a, const PolarLine& b) {
  double da = wrap_angle(a.alpha - b.alpha);
  double rho = a.rho;
  if (std::fabs(da) > kPi / 2) {
    rho = -rho;
    da = wrap_angle(da - kPi);
  }
  return {std::fabs(rho - b.rho), std::fabs(da)};
}

}  // namespace scanbench
