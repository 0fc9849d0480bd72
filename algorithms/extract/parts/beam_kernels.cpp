// Normal equations of a beam line in lanes.
#include "algorithms/extract/parts/beam_kernels.hpp"

#include "core/lanes/lanes.hpp"

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

using FourDoubles = Lanes<double, kBeamLanes>;

// The weight of a reading, r^4 / variance, on a wall with inverse range u and slope k / u^2. All terms of the variance
// are multiplied by u^4, so that one division remains.
SCANBENCH_INLINE FourDoubles weight_of(FourDoubles u, FourDoubles k, const VarianceTerms& variance) {
  const FourDoubles u2 = u * u;
  const FourDoubles u4 = u2 * u2;
  const FourDoubles constant = variance.constant_m2 * u4;
  const FourDoubles relative = variance.relative2 * u2;
  FourDoubles gaussian = constant + relative;
  if (variance.relative_from_m > 0) gaussian = select(u * variance.relative_from_m > 1.0, constant, relative);
  const FourDoubles sum = gaussian + variance.rounding_m2 * u4 + variance.bearing_rad2 * (k * k);
  const FourDoubles least = variance.least_m2 * u4;
  return 1.0 / select(sum > least, sum, least);
}

struct Sums {
  FourDoubles xx{}, xy{}, yy{}, x{}, y{};
  FourDoubles least = FourDoubles{} + __builtin_inf();
};

// `left`: number of readings from this one on. Copies behind the last one have no weight.
SCANBENCH_INLINE void add(FourDoubles x, FourDoubles y, FourDoubles u, FourDoubles error, int left, FourDoubles weight,
                          Sums& sums) {
  if (left < kBeamLanes) weight = masked(first_lanes<FourDoubles>(left), weight);
  const FourDoubles wx = weight * x;
  const FourDoubles wy = weight * y;
  sums.xx += wx * x;
  sums.xy += wx * y;
  sums.yy += wy * y;
  sums.x += wx * error;
  sums.y += wy * error;
  sums.least = select(u < sums.least, u, sums.least);
}

SCANBENCH_INLINE BeamSums totals(const Sums& s) {
  const double a = s.least[0] < s.least[1] ? s.least[0] : s.least[1];
  const double b = s.least[2] < s.least[3] ? s.least[2] : s.least[3];
  return {total(s.xx), total(s.xy), total(s.yy), total(s.x), total(s.y), a < b ? a : b};
}

BeamSums linear(const BeamArrays& readings, const VarianceTerms& variance) {
  Sums sums;
  for (int i = 0; i < readings.count; i += kBeamLanes) {
    const auto x = load<FourDoubles>(readings.x + i);
    const auto y = load<FourDoubles>(readings.y + i);
    const auto range = load<FourDoubles>(readings.range + i);
    const FourDoubles u = 1.0 / range;
    add(x, y, u, u, readings.count - i, weight_of(u, FourDoubles{}, variance), sums);
  }
  return totals(sums);
}

BeamSums step(const BeamArrays& readings, const double theta[2], const VarianceTerms& variance) {
  Sums sums;
  for (int i = 0; i < readings.count; i += kBeamLanes) {
    const auto x = load<FourDoubles>(readings.x + i);
    const auto y = load<FourDoubles>(readings.y + i);
    const auto range = load<FourDoubles>(readings.range + i);
    const FourDoubles u = theta[0] * x + theta[1] * y;
    const FourDoubles k = theta[0] * y - theta[1] * x;
    add(x, y, u, u - range * (u * u), readings.count - i, weight_of(u, k, variance), sums);
  }
  return totals(sums);
}

}  // namespace

extern const BeamKernels
    kBeamKernels;  // NOLINT(readability-redundant-declaration): seen by clang-tidy for one of two builds
const BeamKernels kBeamKernels{.linear = linear, .step = step};

}  // namespace scanbench::extract::SCANBENCH_ISA
