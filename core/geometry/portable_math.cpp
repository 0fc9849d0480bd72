// Argument reduction to a short interval, followed by a Taylor series whose remainder is below a tenth of an ulp.
#include "core/geometry/portable_math.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/geometry/angles.hpp"
#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::portable {
namespace {

// pi/2 and ln 2 as sums of parts with trailing zero bits, so that k * part is exact for all k in use (Cody & Waite).
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kLn2High = 0x1.62e42feep-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;

// sin x / x and cos x on |x| <= pi/4, in x^2.
double sin_series(double x) {
  const double z = x * x;
  double p = -1.0 / 121645100408832000.0;
  p = p * z + 1.0 / 355687428096000.0;
  p = p * z - 1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  return x + x * (z * p);
}

double cos_series(double x) {
  const double z = x * x;
  double p = 1.0 / 2432902008176640000.0;
  p = p * z - 1.0 / 6402373705728000.0;
  p = p * z + 1.0 / 20922789888000.0;
  p = p * z - 1.0 / 87178291200.0;
  p = p * z + 1.0 / 479001600.0;
  p = p * z - 1.0 / 3628800.0;
  p = p * z + 1.0 / 40320.0;
  p = p * z - 1.0 / 720.0;
  p = p * z + 1.0 / 24.0;
  // 1 - z/2 loses the low bits of z/2; they are added back.
  const double half = 0.5 * z;
  const double head = 1.0 - half;
  return head + (((1.0 - head) - half) + z * z * p);
}

// atan(k/8) for k = 0..8, rounded to double.
constexpr std::array<double, 9> kAtanOfEighths = {0.0,
                                                  0.12435499454676143503,
                                                  0.24497866312686415417,
                                                  0.35877067027057222038,
                                                  0.46364760900080611621,
                                                  0.55859931534356243597,
                                                  0.64350110879328438680,
                                                  0.71882999962162450542,
                                                  0.78539816339744830962};

// atan t for t in [0, 1]: the value at the nearest eighth plus the series of the remainder, |u| <= 1/16.
double atan_unit(double t) {
  const int k = static_cast<int>(t * 8.0 + 0.5);  // NOLINT(bugprone-incorrect-roundings): any near eighth will do
  const double c = k / 8.0;
  const double u = (t - c) / (1.0 + t * c);
  const double z = u * u;
  double p = 1.0 / 13.0;
  p = p * z - 1.0 / 11.0;
  p = p * z + 1.0 / 9.0;
  p = p * z - 1.0 / 7.0;
  p = p * z + 1.0 / 5.0;
  p = p * z - 1.0 / 3.0;
  return kAtanOfEighths[as_index(k)] + (u + u * (z * p));
}

}  // namespace

SinCos sincos(double x) {
  if (!(std::fabs(x) <= 1e5)) return {kNaN, kNaN};
  const double k = std::floor(x * (2.0 / kPi) + 0.5);
  const double r = ((x - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;
  const double s = sin_series(r);
  const double c = cos_series(r);
  switch (static_cast<std::int64_t>(k) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double a = 0.0;
  if (ax == ay) {
    a = kAtanOfEighths[8];
  } else if (ay < ax) {
    a = atan_unit(ay / ax);
  } else {
    a = kPi / 2 - atan_unit(ax / ay);
  }
  if (x < 0) a = kPi - a;
  return y < 0 ? -a : a;
}

double log(double x) {
  if (std::isnan(x) || x < 0) return kNaN;
  if (x == 0) return -kInf;
  if (x == kInf) return kInf;
  int e = 0;
  double m = std::frexp(x, &e);  // [0.5, 1), exact
  if (m < 0.70710678118654752440) {
    m *= 2.0;
    e -= 1;
  }
  // log m = 2 atanh s = f - s (f - ...) with f = m - 1. In this form the large part, f, is exact.
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  double p = 1.0 / 23.0;
  for (int n = 21; n >= 3; n -= 2) p = p * z + 1.0 / n;
  const double tail = 2.0 * s * z * p;  // 2 (s^3/3 + s^5/5 + ...)
  const double two_s = f - s * f;       // 2 s = f - s f
  return e * kLn2High + (two_s + (tail + e * kLn2Low));
}

double exp(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 709.0) return kInf;
  if (x < -708.0) return 0.0;
  const double k = std::floor(x * 1.44269504088896340736 + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double p = 1.0;
  for (int n = 14; n >= 2; --n) p = 1.0 + p * r / n;
  const double y = 1.0 + r * p;
  const auto exponent = static_cast<std::int64_t>(k);
  if (exponent > 1023) return y * 2.0 * std::bit_cast<double>(std::int64_t{(exponent - 1 + 1023)} << 52);
  return y * std::bit_cast<double>(std::int64_t{(exponent + 1023)} << 52);
}

}  // namespace scanbench::portable
