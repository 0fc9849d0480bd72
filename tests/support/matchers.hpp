// Matchers for angles, points and lines. NaN never matches.
#pragma once

#include <cmath>

#include <gmock/gmock.h>

#include "core/geometry/geometry.hpp"

namespace scanbench::support {

/// An angle within `tolerance` radians of `expected`, on the circle.
MATCHER_P2(AngleNear, expected, tolerance, "") {
  const double d = std::fabs(wrap_angle(arg - expected));
  *result_listener << "off by " << d << " rad on the circle";
  return d <= tolerance;
}

/// An undirected direction within `tolerance` radians of `expected`, modulo pi.
MATCHER_P2(DirectionNear, expected, tolerance, "") {
  const double d = std::fabs(wrap_direction(arg - expected));
  *result_listener << "off by " << d << " rad modulo pi";
  return d <= tolerance;
}

/// A point within `tolerance` metres of `expected`.
MATCHER_P2(PointNear, expected, tolerance, "") {
  const double d = (arg - expected).norm();
  *result_listener << "off by " << d << " m";
  return d <= tolerance;
}

/// A line whose difference to `expected`, as of line_difference(), is within both tolerances.
MATCHER_P3(LineNear, expected, rho_m, alpha_rad, "") {
  const LineDifference d = line_difference(arg, expected);
  *result_listener << "(" << arg.rho << " m, " << arg.alpha << " rad), off by " << d.rho << " m, " << d.alpha << " rad";
  return d.rho <= rho_m && d.alpha <= alpha_rad;
}

/// A segment with the same two end points, in either order, within `tolerance` metres.
MATCHER_P2(SegmentNear, expected, tolerance, "") {
  const double same = std::fmax((arg.a - expected.a).norm(), (arg.b - expected.b).norm());
  const double swapped = std::fmax((arg.a - expected.b).norm(), (arg.b - expected.a).norm());
  *result_listener << "ends off by " << same << " m, or swapped by " << swapped << " m";
  return (same <= tolerance || swapped <= tolerance) && std::isfinite(same) && std::isfinite(swapped);
}

}  // namespace scanbench::support
