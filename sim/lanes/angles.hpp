// Angles in lanes. They only select candidate beams and are never part of a result.
#pragma once

#include "core/lanes/lanes.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

inline constexpr double kPiHere = 0x1.921fb54442d18p+1;

/// Upper bound of the error of atan2_near() and the subtractions after it.
inline constexpr double kAngleError = 1e-6;

/// Angle of (x, y) in [-pi, pi] with an error of at most 4.2e-7: a polynomial through the Chebyshev nodes of atan(sqrt
/// z) / sqrt z on [0, 1]. The result for (0, 0) is arbitrary.
inline Doubles atan2_near(Doubles y, Doubles x) {
  const Doubles ax = abs(x);
  const Doubles ay = abs(y);
  const Doubles t = min(ax, ay) / (max(ax, ay) + 1e-300);
  const Doubles z = t * t;
  Doubles p = z * 0.007648353926762766 + -0.03636043085731773;
  p = p * z + 0.08312645300619582;
  p = p * z + -0.13447864058090495;
  p = p * z + 0.19872040268214597;
  p = p * z + -0.33325678039723927;
  p = p * z + 0.9999992255890977;
  Doubles a = p * t;
  a = ay > ax ? kPiHere / 2 - a : a;
  a = x < 0.0 ? kPiHere - a : a;
  return y < 0.0 ? -a : a;
}

/// A difference of two such angles in (-pi, pi].
inline Doubles wrapped(Doubles angle) {
  angle = angle > kPiHere ? angle - 2 * kPiHere : angle;
  return angle <= -kPiHere ? angle + 2 * kPiHere : angle;
}

}  // namespace scanbench::sim::SCANBENCH_ISA
