// Elementary functions in lanes. Logarithm and cosine have the bits of core/geometry/portable_math.hpp.
#pragma once

#include "core/geometry/portable_series.hpp"
#include "core/lanes/lanes.hpp"

namespace scanbench {
inline namespace SCANBENCH_ISA {

/// Whole numbers below 2^52 as doubles.
SCANBENCH_INLINE Doubles to_double(Words whole) {
  return reinterpret_cast<Doubles>(whole | 0x4330000000000000ULL) - 0x1p52;
}

/// Natural logarithm of positive, normal, finite numbers.
SCANBENCH_INLINE Doubles log(Doubles x) {
  // frexp: x = m 2^e with m in [0.5, 1).
  const auto word = reinterpret_cast<Words>(x);
  Doubles e = to_double(word >> 52) - 1022.0;
  auto m = reinterpret_cast<Doubles>((word & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL);
  const Longs small = m < 0.70710678118654752440;
  m = small ? m * 2.0 : m;
  e = small ? e - 1.0 : e;
  return portable::log_series(m, e);
}

/// Cosine of numbers in [0, 1e5].
SCANBENCH_INLINE Doubles cos(Doubles x) {
  constexpr double kPiHalfInverse = 2.0 / 3.14159265358979323846;
  // floor of a number that is not negative
  const Doubles y = x * kPiHalfInverse + 0.5;
  Doubles k = (y + 0x1p52) - 0x1p52;
  k = k > y ? k - 1.0 : k;
  const Longs quadrant = bits(k + 0x1p52) & 3;
  const Doubles r = portable::without_quarter_turns(x, k);
  const Doubles value = (quadrant & 1) != 0 ? portable::sin_series(r) : portable::cos_series(r);
  // c, -s, -c, s
  const Words negative = reinterpret_cast<Words>((quadrant + 1) & 2) << 62;
  return reinterpret_cast<Doubles>(reinterpret_cast<Words>(value) ^ negative);
}

/// 2^y of floats for -126 < y <= 0; undefined for other y. 2^y = 2^n 2^f with |f| <= 1/2. Adding 1.5 * 2^23 rounds to
/// the nearest integer, which is then in the low bits. 2^f is a Taylor polynomial of degree 5 with a remainder below
/// (ln 2 / 2)^6 / 6! = 2.5e-6.
template <class V>
SCANBENCH_INLINE V exp2(V y) {
  using Bits = Lanes<unsigned, static_cast<int>(sizeof(V) / sizeof(float))>;
  const V rounded = y + 12582912.0F;
  const V f = y - (rounded - 12582912.0F);
  V p = 0.0013333558F * f + 0.0096181291F;
  p = p * f + 0.0555041087F;
  p = p * f + 0.2402265070F;
  p = p * f + 0.6931471806F;
  p = p * f + 1.0F;
  return reinterpret_cast<V>(reinterpret_cast<Bits>(p) + (reinterpret_cast<Bits>(rounded) << 23));
}

/// 1 / sqrt(v) of floats with a relative error below 5e-6; finite for 0. An estimate from the exponent is improved by
/// two Newton steps: the processors' own estimates differ between makers.
template <class V>
SCANBENCH_INLINE V reciprocal_root(V v) {
  auto r = reinterpret_cast<V>(0x5f3759df - (bits(v) >> 1));
  const V half = v * 0.5F;
  r = r * (1.5F - half * r * r);
  return r * (1.5F - half * r * r);
}

}  // namespace SCANBENCH_ISA
}  // namespace scanbench
