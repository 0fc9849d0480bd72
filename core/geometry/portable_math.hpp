// Elementary functions whose results do not depend on the machine.
//
// glibc chooses FMA variants of sin, cos, log and exp at run time, and they differ from the plain ones in the last bit.
// Everything in a recording is computed with the functions below: they use only + - * / and sqrt, which IEEE 754
// defines to the last bit, so the same seed gives the same bytes with gcc or clang, debug or release (the build never
// contracts a*b+c). Errors stay under 2 ulp over the stated ranges (tests/core/geometry/portable_math_test.cpp compares
// them with long double).
#pragma once

namespace scanbench::portable {

struct SinCos {
  double sin;
  double cos;
};

/// |x| <= 1e5; for larger values, NaN and infinities both are NaN: no angle in this program is that large.
SinCos sincos(double x);

/// Angle of (x, y) in (-pi, pi]; atan2(0, 0) = 0; NaN if either is NaN. The sign of a zero is ignored.
double atan2(double y, double x);

/// Natural logarithm of a positive, finite, normal number; -inf for 0, NaN for negative numbers and NaN, +inf for +inf.
double log(double x);

/// e to the x: 0 below -708, +inf above 709, NaN for NaN.
double exp(double x);

}  // namespace scanbench::portable
