// Angles in radians, counter-clockwise positive; names of values in degrees end in _deg or say degrees.
#pragma once

#include <cmath>

namespace scanbench {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / kPi);
}

/// Wraps to (-pi, pi]. Exact for inputs already in this range; NaN and infinities give NaN.
inline double wrap_angle(double a) {
  const double r = std::remainder(a, kTwoPi);  // [-pi, pi], and exact by IEEE 754
  return r <= -kPi ? r + kTwoPi : r;
}

/// Wraps the difference of two undirected directions to (-pi/2, pi/2].
inline double wrap_direction(double a) {
  const double r = std::remainder(a, kPi);
  return r <= -kPi / 2 ? r + kPi : r;
}

/// The representative of an undirected direction in [0, pi).
inline double direction_mod_pi(double a) {
  const double r = wrap_direction(a);
  const double d = r < 0 ? r + kPi : r;
  return d >= kPi ? 0.0 : d;
}

}  // namespace scanbench
