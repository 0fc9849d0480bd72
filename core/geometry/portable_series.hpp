// The series of the portable elementary functions, for one double and for lanes of doubles (core/lanes): the same
// operations in the same order, hence the same bits.
//
// Always inlined: kernels are compiled for several processors and must not share code.
#pragma once

namespace scanbench::portable {

// ln 2 as a sum of parts with trailing zero bits, so that k * part is exact for all k in use (Cody & Waite).
inline constexpr double kLn2High = 0x1.62e42feep-1;
inline constexpr double kLn2Low = 0x1.a39ef35793c76p-33;

/// x - k pi/2, with pi/2 in three parts like ln 2.
template <class D>
[[gnu::always_inline]] inline D without_quarter_turns(D x, D k) {
  return ((x - k * 0x1.921fb544p+0) - k * 0x1.0b4611a6p-34) - k * 0x1.3198a2e037073p-69;
}

/// Sine on |x| <= pi/4.
template <class D>
[[gnu::always_inline]] inline D sin_series(D x) {
  const D z = x * x;
  D p = z * (-1.0 / 121645100408832000.0) + 1.0 / 355687428096000.0;
  p = p * z - 1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  return x + x * (z * p);
}

/// Cosine on |x| <= pi/4.
template <class D>
[[gnu::always_inline]] inline D cos_series(D x) {
  const D z = x * x;
  D p = z * (1.0 / 2432902008176640000.0) - 1.0 / 6402373705728000.0;
  p = p * z + 1.0 / 20922789888000.0;
  p = p * z - 1.0 / 87178291200.0;
  p = p * z + 1.0 / 479001600.0;
  p = p * z - 1.0 / 3628800.0;
  p = p * z + 1.0 / 40320.0;
  p = p * z - 1.0 / 720.0;
  p = p * z + 1.0 / 24.0;
  // 1 - z/2 loses the low bits of z/2; they are added back.
  const D half = 0.5 * z;
  const D head = 1.0 - half;
  return head + (((1.0 - head) - half) + z * z * p);
}

/// Natural logarithm of m 2^e for m in [sqrt(1/2), sqrt 2).
template <class D>
[[gnu::always_inline]] inline D log_series(D m, D e) {
  // log m = 2 atanh s = f - s (f - ...) with f = m - 1. In this form the large part, f, is exact.
  const D f = m - 1.0;
  const D s = f / (2.0 + f);
  const D z = s * s;
  D p = D{} + 1.0 / 23.0;
  for (int n = 21; n >= 3; n -= 2) p = p * z + 1.0 / n;
  const D tail = 2.0 * s * z * p;  // 2 (s^3/3 + s^5/5 + ...)
  const D two_s = f - s * f;       // 2 s = f - s f
  return e * kLn2High + (two_s + (tail + e * kLn2Low));
}

}  // namespace scanbench::portable
