// Sums of a truncated Gaussian kernel over candidates (Lakaemper 2009, eq. 1) and the selection of candidates, in
// lanes.
#include "algorithms/merge/mean_shift/sum_kernels.hpp"

#include "core/lanes/elementary.hpp"
#include "core/lanes/lanes.hpp"

namespace scanbench::merge::SCANBENCH_ISA {
namespace {

using Floats = Lanes<float, kSumLanes>;
using FourDoubles = Lanes<double, kNearLanes>;

/// exp(-squared / 2)
SCANBENCH_INLINE Floats gaussian_lanes(Floats squared) {
  return exp2(squared * -0.72134752F);
}

void gaussian(const float* squared, float* out) {
  store(out, gaussian_lanes(load<Floats>(squared)));
}

FirstSums first(const CandidateArrays& candidates, const float t[3], float squared_cutoff) {
  Floats mass{}, sx{}, sy{}, sz{};
  for (int i = 0; i < candidates.count; i += kSumLanes) {
    const Floats dx = load<Floats>(candidates.x + i) - t[0];
    const Floats dy = load<Floats>(candidates.y + i) - t[1];
    const Floats dz = load<Floats>(candidates.z + i) - t[2];
    const Floats squared = dx * dx + dy * dy + dz * dz;
    const Floats w = masked(squared <= squared_cutoff, gaussian_lanes(squared));
    mass += w;
    sx += w * dx;
    sy += w * dy;
    sz += w * dz;
  }
  return {total(mass), total(sx), total(sy), total(sz)};
}

SecondSums second(const CandidateArrays& candidates, const float t[3], float squared_cutoff) {
  const Floats at_cutoff = gaussian_lanes(all<Floats>(squared_cutoff));
  Floats mass{}, density{}, sx{}, sy{}, sz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (int i = 0; i < candidates.count; i += kSumLanes) {
    const Floats dx = load<Floats>(candidates.x + i) - t[0];
    const Floats dy = load<Floats>(candidates.y + i) - t[1];
    const Floats dz = load<Floats>(candidates.z + i) - t[2];
    const Floats squared = dx * dx + dy * dy + dz * dz;
    const Floats kernel = gaussian_lanes(squared);
    const auto inside = squared <= squared_cutoff;
    const Floats w = masked(inside, kernel);
    density += masked(inside, kernel - at_cutoff);
    const Floats wx = w * dx;
    const Floats wy = w * dy;
    const Floats wz = w * dz;
    mass += w;
    sx += wx;
    sy += wy;
    sz += wz;
    xx += wx * dx;
    xy += wx * dy;
    xz += wx * dz;
    yy += wy * dy;
    yz += wy * dz;
    zz += wz * dz;
  }
  return {{total(mass), total(sx), total(sy), total(sz)},
          total(density),
          total(xx),
          total(xy),
          total(xz),
          total(yy),
          total(yz),
          total(zz)};
}

/// max(0, |d| - half)
SCANBENCH_INLINE FourDoubles beyond(FourDoubles d, double half) {
  const FourDoubles o = abs(d) - half;
  return masked(o > 0.0, o);
}

int select_lanes(const double* x, const double* y, const double* z, int lanes, const NearBox& box, float* out_x,
                 float* out_y, float* out_z, int found) {
  const FourDoubles dx = load<FourDoubles>(x) - box.centre[0];
  const FourDoubles dy = load<FourDoubles>(y) - box.centre[1];
  FourDoubles dz = load<FourDoubles>(z) - box.centre[2];
  if (box.period > 0) {
    const auto turn = all<FourDoubles>(box.period);
    const auto high = dz >= 0.5 * box.period;
    const auto low = dz < -0.5 * box.period;
    dz = dz - masked(high, turn) + masked(low, turn);
  }
  const FourDoubles ox = beyond(dx, box.half[0]);
  const FourDoubles oy = beyond(dy, box.half[1]);
  const FourDoubles oz = beyond(dz, box.half[2]);
  const auto inside = ox * ox + oy * oy + oz * oz <= box.squared_radius;
  using FewFloats = Lanes<float, kNearLanes>;
  const FewFloats fx = __builtin_convertvector(dx, FewFloats);
  const FewFloats fy = __builtin_convertvector(dy, FewFloats);
  const FewFloats fz = __builtin_convertvector(dz, FewFloats);
  for (int lane = 0; lane < lanes; ++lane) {
    out_x[found] = fx[lane];  // kept if the index moves on
    out_y[found] = fy[lane];
    out_z[found] = fz[lane];
    found -= static_cast<int>(inside[lane]);
  }
  return found;
}

int select(const double* x, const double* y, const double* z, int count, const NearBox& box, float* out_x, float* out_y,
           float* out_z) {
  int found = 0;
  int i = 0;
  for (; i + kNearLanes <= count; i += kNearLanes)
    found = select_lanes(x + i, y + i, z + i, kNearLanes, box, out_x, out_y, out_z, found);
  if (i < count) {
    double rest[3][kNearLanes] = {};
    for (int k = 0; i + k < count; ++k) {
      rest[0][k] = x[i + k];
      rest[1][k] = y[i + k];
      rest[2][k] = z[i + k];
    }
    found = select_lanes(rest[0], rest[1], rest[2], count - i, box, out_x, out_y, out_z, found);
  }
  return found;
}

}  // namespace

extern const SumKernels
    kSumKernels;  // NOLINT(readability-redundant-declaration): seen by clang-tidy for one of two builds
const SumKernels kSumKernels{.gaussian = gaussian, .first = first, .second = second, .select = select};

}  // namespace scanbench::merge::SCANBENCH_ISA
