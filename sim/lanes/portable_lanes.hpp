// The logarithm and the cosine of core/geometry/portable_math.cpp in lanes: the same operations in the same order,
// hence the same bits (tests/sim/draw_kernels_test.cpp compares them).
#pragma once

#include "sim/lanes/lanes.hpp"

namespace scanbench::sim::SCANBENCH_ISA {

/// Whole numbers below 2^52 as doubles.
inline WideDoubles to_double(WideWords whole) {
  return reinterpret_cast<WideDoubles>(whole | 0x4330000000000000ULL) - 0x1p52;
}

/// Natural logarithm of positive, normal, finite numbers.
inline WideDoubles log_lanes(WideDoubles x) {
  // frexp: x = m 2^e with m in [0.5, 1).
  const WideWords word = reinterpret_cast<WideWords>(x);
  WideDoubles e = to_double(word >> 52) - 1022.0;
  WideDoubles m = reinterpret_cast<WideDoubles>((word & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL);
  const WideLongs small = m < 0.70710678118654752440;
  m = small ? m * 2.0 : m;
  e = small ? e - 1.0 : e;
  const WideDoubles f = m - 1.0;
  const WideDoubles s = f / (2.0 + f);
  const WideDoubles z = s * s;
  auto p = every<WideDoubles>(1.0 / 23.0);
  for (int n = 21; n >= 3; n -= 2) p = p * z + 1.0 / n;
  const WideDoubles tail = 2.0 * s * z * p;
  const WideDoubles two_s = f - s * f;
  return e * 0x1.62e42feep-1 + (two_s + (tail + e * 0x1.a39ef35793c76p-33));
}

/// Cosine of numbers in [0, 2^20].
inline WideDoubles cos_lanes(WideDoubles x) {
  constexpr double kPiHalfInverse = 2.0 / 3.14159265358979323846;
  // floor of a number that is not negative
  const WideDoubles y = x * kPiHalfInverse + 0.5;
  WideDoubles k = (y + 0x1p52) - 0x1p52;
  k = k > y ? k - 1.0 : k;
  const WideLongs quadrant = reinterpret_cast<WideLongs>(k + 0x1p52) & 3;
  const WideDoubles r = ((x - k * 0x1.921fb544p+0) - k * 0x1.0b4611a6p-34) - k * 0x1.3198a2e037073p-69;
  const WideDoubles z = r * r;

  WideDoubles p = z * (-1.0 / 121645100408832000.0) + 1.0 / 355687428096000.0;
  p = p * z - 1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  const WideDoubles sine = r + r * (z * p);

  WideDoubles q = z * (1.0 / 2432902008176640000.0) - 1.0 / 6402373705728000.0;
  q = q * z + 1.0 / 20922789888000.0;
  q = q * z - 1.0 / 87178291200.0;
  q = q * z + 1.0 / 479001600.0;
  q = q * z - 1.0 / 3628800.0;
  q = q * z + 1.0 / 40320.0;
  q = q * z - 1.0 / 720.0;
  q = q * z + 1.0 / 24.0;
  const WideDoubles half = 0.5 * z;
  const WideDoubles head = 1.0 - half;
  const WideDoubles cosine = head + (((1.0 - head) - half) + z * z * q);

  const WideDoubles value = (quadrant & 1) != 0 ? sine : cosine;
  // c, -s, -c, s
  const WideWords negative = reinterpret_cast<WideWords>((quadrant + 1) & 2) << 62;
  return reinterpret_cast<WideDoubles>(reinterpret_cast<WideWords>(value) ^ negative);
}

}  // namespace scanbench::sim::SCANBENCH_ISA
