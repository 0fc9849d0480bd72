// Normal equations of a beam line in lanes. Nothing here is a function that the linker could merge between the two
// builds.
#include "algorithms/extract/parts/beam_kernels.hpp"

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

typedef double Doubles __attribute__((vector_size(8 * kBeamLanes)));                              // NOLINT
typedef long long Longs __attribute__((vector_size(8 * kBeamLanes)));                             // NOLINT
typedef double LooseDoubles __attribute__((vector_size(8 * kBeamLanes), aligned(8), may_alias));  // NOLINT

// Functions take vectors by reference and are inlined: the two builds pass vectors in different registers.
#define SCANBENCH_INLINE __attribute__((always_inline)) inline

SCANBENCH_INLINE void load(const double* p, Doubles& v) {
  v = *reinterpret_cast<const LooseDoubles*>(p);
}

SCANBENCH_INLINE void select(const Longs& mask, const Doubles& yes, const Doubles& no, Doubles& out) {
  out = reinterpret_cast<Doubles>((reinterpret_cast<Longs>(yes) & mask) | (reinterpret_cast<Longs>(no) & ~mask));
}

SCANBENCH_INLINE double total(const Doubles& v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

// The weight of a reading, r^4 / variance, on a wall with inverse range u and slope k / u^2. All terms of the variance
// are multiplied by u^4, so that one division remains.
SCANBENCH_INLINE void weight_of(const Doubles& u, const Doubles& k, const VarianceTerms& variance, Doubles& weight) {
  const Doubles u2 = u * u;
  const Doubles u4 = u2 * u2;
  const Doubles constant = variance.constant_m2 * u4;
  const Doubles relative = variance.relative2 * u2;
  Doubles gaussian = constant + relative;
  if (variance.relative_from_m > 0) select(u * variance.relative_from_m > 1.0, constant, relative, gaussian);
  const Doubles sum = gaussian + variance.rounding_m2 * u4 + variance.bearing_rad2 * (k * k);
  const Doubles least = variance.least_m2 * u4;
  Doubles divisor;
  select(sum > least, sum, least, divisor);
  weight = 1.0 / divisor;
}

struct Sums {
  Doubles xx{}, xy{}, yy{}, x{}, y{};
  Doubles least = Doubles{} + __builtin_inf();
};

// `left`: number of readings from this one on. Copies behind the last one have no weight.
SCANBENCH_INLINE void add(const Doubles& x, const Doubles& y, const Doubles& u, const Doubles& error, int left,
                          Doubles& weight, Sums& sums) {
  const Longs lane = {0, 1, 2, 3};
  if (left < kBeamLanes) select(lane < static_cast<long long>(left), weight, Doubles{}, weight);
  const Doubles wx = weight * x;
  const Doubles wy = weight * y;
  sums.xx += wx * x;
  sums.xy += wx * y;
  sums.yy += wy * y;
  sums.x += wx * error;
  sums.y += wy * error;
  select(u < sums.least, u, sums.least, sums.least);
}

SCANBENCH_INLINE BeamSums totals(const Sums& s) {
  const double a = s.least[0] < s.least[1] ? s.least[0] : s.least[1];
  const double b = s.least[2] < s.least[3] ? s.least[2] : s.least[3];
  return {total(s.xx), total(s.xy), total(s.yy), total(s.x), total(s.y), a < b ? a : b};
}

BeamSums linear(const BeamArrays& readings, const VarianceTerms& variance) {
  Sums sums;
  for (int i = 0; i < readings.count; i += kBeamLanes) {
    Doubles x, y, range, weight;
    load(readings.x + i, x);
    load(readings.y + i, y);
    load(readings.range + i, range);
    const Doubles u = 1.0 / range;
    weight_of(u, Doubles{}, variance, weight);
    add(x, y, u, u, readings.count - i, weight, sums);
  }
  return totals(sums);
}

BeamSums step(const BeamArrays& readings, const double theta[2], const VarianceTerms& variance) {
  Sums sums;
  for (int i = 0; i < readings.count; i += kBeamLanes) {
    Doubles x, y, range, weight;
    load(readings.x + i, x);
    load(readings.y + i, y);
    load(readings.range + i, range);
    const Doubles u = theta[0] * x + theta[1] * y;
    const Doubles k = theta[0] * y - theta[1] * x;
    weight_of(u, k, variance, weight);
    add(x, y, u, u - range * (u * u), readings.count - i, weight, sums);
  }
  return totals(sums);
}

}  // namespace

extern const BeamKernels
    kBeamKernels;  // NOLINT(readability-redundant-declaration): seen by clang-tidy for one of two builds
const BeamKernels kBeamKernels{.linear = linear, .step = step};

}  // namespace scanbench::extract::SCANBENCH_ISA
