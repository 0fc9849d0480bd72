// Argument reduction to a short interval, followed by a Taylor series whose remainder is below a tenth of an ulp.
#include "core/geometry/portable_math.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/geometry/angles.hpp"
#include "core/geometry/portable_series.hpp"
#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::portable {
namespace {

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
  const double r = without_quarter_turns(x, k);
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
  return log_series(m, static_cast<double>(e));
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
