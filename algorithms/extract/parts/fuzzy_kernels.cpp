// Memberships and moments of fuzzy clusters in lanes (Borges & Aldon 2000, section 2.3).
#include "algorithms/extract/parts/fuzzy_kernels.hpp"

#include "core/lanes/lanes.hpp"

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

using FourDoubles = Lanes<double, kFuzzyLanes>;

/// Eq. (4).
SCANBENCH_INLINE FourDoubles squared_distance(const TwoLines& lines, int i, FourDoubles x, FourDoubles y,
                                              FourDoubles& dx, FourDoubles& dy) {
  const FourDoubles f = lines.rho[i] - (lines.normal_x[i] * x + lines.normal_y[i] * y);
  dx = x - lines.centre_x[i];
  dy = y - lines.centre_y[i];
  FourDoubles squared = f * f;
  if (lines.penalty) squared += dx * dx + dy * dy;  // eq. (10)
  return squared;
}

TwoMeans memberships(const PointArrays& points, const TwoLines& lines, double* const u[2]) {
  FourDoubles cost{}, w0{}, x0{}, y0{}, w1{}, x1{}, y1{};
  for (int j = 0; j < points.count; j += kFuzzyLanes) {
    const auto x = load<FourDoubles>(points.x + j);
    const auto y = load<FourDoubles>(points.y + j);
    FourDoubles dx0, dy0, dx1, dy1;
    const FourDoubles d0 = squared_distance(lines, 0, x, y, dx0, dy0);
    const FourDoubles d1 = squared_distance(lines, 1, x, y, dx1, dy1);
    const FourDoubles sum = d0 + d1;
    const auto on0 = d0 <= kZeroDistance2;
    const auto on1 = d1 <= kZeroDistance2;
    const auto one = all<FourDoubles>(1.0);
    const FourDoubles shared0 = on1 ? 0.5 * one : one;
    const FourDoubles shared1 = on0 ? 0.5 * one : one;
    FourDoubles u0 = on0 ? shared0 : (on1 ? FourDoubles{} : d1 / sum);  // eq. (6) for C = 2 and m = 2
    FourDoubles u1 = on1 ? shared1 : (on0 ? FourDoubles{} : d0 / sum);
    if (j + kFuzzyLanes > points.count) {
      const auto exists = first_lanes<FourDoubles>(points.count - j);
      u0 = masked(exists, u0);
      u1 = masked(exists, u1);
    }
    store(u[0] + j, u0);
    store(u[1] + j, u1);
    u0 *= u0;
    u1 *= u1;
    cost += u0 * d0 + u1 * d1;
    w0 += u0;
    x0 += u0 * dx0;
    y0 += u0 * dy0;
    w1 += u1;
    x1 += u1 * dx1;
    y1 += u1 * dy1;
  }
  return {total(cost), {total(w0), total(w1)}, {total(x0), total(x1)}, {total(y0), total(y1)}};
}

TwoMoments moments(const PointArrays& points, const double* const u[2], const double centre_x[2],
                   const double centre_y[2]) {
  FourDoubles xx0{}, xy0{}, yy0{}, xx1{}, xy1{}, yy1{};
  for (int j = 0; j < points.count; j += kFuzzyLanes) {
    const auto x = load<FourDoubles>(points.x + j);
    const auto y = load<FourDoubles>(points.y + j);
    auto w0 = load<FourDoubles>(u[0] + j);
    auto w1 = load<FourDoubles>(u[1] + j);
    w0 *= w0;
    w1 *= w1;
    const FourDoubles dx0 = x - centre_x[0], dy0 = y - centre_y[0];
    const FourDoubles dx1 = x - centre_x[1], dy1 = y - centre_y[1];
    xx0 += w0 * dx0 * dx0;
    xy0 += w0 * dx0 * dy0;
    yy0 += w0 * dy0 * dy0;
    xx1 += w1 * dx1 * dx1;
    xy1 += w1 * dx1 * dy1;
    yy1 += w1 * dy1 * dy1;
  }
  return {{total(xx0), total(xx1)}, {total(xy0), total(xy1)}, {total(yy0), total(yy1)}};
}

}  // namespace

extern const FuzzyKernels kFuzzyKernels;
const FuzzyKernels kFuzzyKernels{.memberships = memberships, .moments = moments};

}  // namespace scanbench::extract::SCANBENCH_ISA
