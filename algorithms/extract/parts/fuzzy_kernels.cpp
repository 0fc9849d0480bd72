// Memberships and moments of fuzzy clusters in lanes (Borges & Aldon 2000, section 2.3). Nothing here is a function
// that the linker could merge between the two builds.
#include "algorithms/extract/parts/fuzzy_kernels.hpp"

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

typedef double Doubles __attribute__((vector_size(8 * kFuzzyLanes)));                              // NOLINT
typedef long long Longs __attribute__((vector_size(8 * kFuzzyLanes)));                             // NOLINT
typedef double LooseDoubles __attribute__((vector_size(8 * kFuzzyLanes), aligned(8), may_alias));  // NOLINT

// Functions take vectors by reference and are inlined: the two builds pass vectors in different registers.
#define SCANBENCH_INLINE __attribute__((always_inline)) inline

SCANBENCH_INLINE void load(const double* p, Doubles& v) {
  v = *reinterpret_cast<const LooseDoubles*>(p);
}

SCANBENCH_INLINE void store(double* p, const Doubles& v) {
  *reinterpret_cast<LooseDoubles*>(p) = v;
}

SCANBENCH_INLINE double total(const Doubles& v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

/// All ones in the lanes of points from `first` on that exist.
SCANBENCH_INLINE void existing(int first, int count, Longs& mask) {
  mask = Longs{0, 1, 2, 3} < static_cast<long long>(count - first);
}

SCANBENCH_INLINE void masked(const Longs& mask, Doubles& v) {
  v = reinterpret_cast<Doubles>(reinterpret_cast<Longs>(v) & mask);
}

/// Eq. (4).
SCANBENCH_INLINE void squared_distance(const TwoLines& lines, int i, const Doubles& x, const Doubles& y, Doubles& dx,
                                       Doubles& dy, Doubles& squared) {
  const Doubles f = lines.rho[i] - (lines.normal_x[i] * x + lines.normal_y[i] * y);
  dx = x - lines.centre_x[i];
  dy = y - lines.centre_y[i];
  squared = f * f;
  if (lines.penalty) squared += dx * dx + dy * dy;  // eq. (10)
}

TwoMeans memberships(const PointArrays& points, const TwoLines& lines, double* const u[2]) {
  Doubles cost{}, w0{}, x0{}, y0{}, w1{}, x1{}, y1{};
  for (int j = 0; j < points.count; j += kFuzzyLanes) {
    Doubles x, y, dx0, dy0, d0, dx1, dy1, d1;
    load(points.x + j, x);
    load(points.y + j, y);
    squared_distance(lines, 0, x, y, dx0, dy0, d0);
    squared_distance(lines, 1, x, y, dx1, dy1, d1);
    const Doubles sum = d0 + d1;
    const Longs on0 = d0 <= kZeroDistance2;
    const Longs on1 = d1 <= kZeroDistance2;
    const Doubles one = Doubles{} + 1.0;
    const Doubles shared0 = on1 ? 0.5 * one : one;
    const Doubles shared1 = on0 ? 0.5 * one : one;
    Doubles u0 = on0 ? shared0 : (on1 ? Doubles{} : d1 / sum);  // eq. (6) for C = 2 and m = 2
    Doubles u1 = on1 ? shared1 : (on0 ? Doubles{} : d0 / sum);
    if (j + kFuzzyLanes > points.count) {
      Longs mask;
      existing(j, points.count, mask);
      masked(mask, u0);
      masked(mask, u1);
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
  Doubles xx0{}, xy0{}, yy0{}, xx1{}, xy1{}, yy1{};
  for (int j = 0; j < points.count; j += kFuzzyLanes) {
    Doubles x, y, w0, w1;
    load(points.x + j, x);
    load(points.y + j, y);
    load(u[0] + j, w0);
    load(u[1] + j, w1);
    w0 *= w0;
    w1 *= w1;
    const Doubles dx0 = x - centre_x[0], dy0 = y - centre_y[0];
    const Doubles dx1 = x - centre_x[1], dy1 = y - centre_y[1];
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
