// Sums of a truncated Gaussian kernel over candidates (Lakaemper 2009, eq. 1) and the selection of candidates, in
// lanes. Nothing here is a function that the linker could merge between the two builds.
#include "algorithms/merge/mean_shift/sum_kernels.hpp"

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

namespace scanbench::merge::SCANBENCH_ISA {
namespace {

typedef float Floats __attribute__((vector_size(4 * kSumLanes)));      // NOLINT(modernize-use-using)
typedef int Ints __attribute__((vector_size(4 * kSumLanes)));          // NOLINT(modernize-use-using)
typedef unsigned Words __attribute__((vector_size(4 * kSumLanes)));    // NOLINT(modernize-use-using)
typedef double Doubles __attribute__((vector_size(8 * kNearLanes)));   // NOLINT(modernize-use-using)
typedef long long Longs __attribute__((vector_size(8 * kNearLanes)));  // NOLINT(modernize-use-using)
typedef float LooseFloats __attribute__((vector_size(4 * kSumLanes), aligned(4), may_alias));     // NOLINT
typedef double LooseDoubles __attribute__((vector_size(8 * kNearLanes), aligned(8), may_alias));  // NOLINT
typedef float FewFloats __attribute__((vector_size(4 * kNearLanes)));                             // NOLINT

// Functions take vectors by reference and are inlined: the two builds pass vectors in different registers.
#define SCANBENCH_INLINE __attribute__((always_inline)) inline

SCANBENCH_INLINE void gaussian_lanes(const Floats& squared, Floats& out) {
  // exp(-s / 2) = 2^n 2^f with |f| <= 1/2; adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the low
  // bits. 2^f: Taylor polynomial of degree 5, remainder below (ln 2 / 2)^6 / 6! = 2.5e-6.
  const Floats y = squared * -0.72134752F;
  const Floats rounded = y + 12582912.0F;
  const Floats f = y - (rounded - 12582912.0F);
  Floats p = 0.0013333558F * f + 0.0096181291F;
  p = p * f + 0.0555041087F;
  p = p * f + 0.2402265070F;
  p = p * f + 0.6931471806F;
  p = p * f + 1.0F;
  out = reinterpret_cast<Floats>(reinterpret_cast<Words>(p) + (reinterpret_cast<Words>(rounded) << 23));
}

SCANBENCH_INLINE void masked(const Ints& mask, Floats& v) {
  v = reinterpret_cast<Floats>(reinterpret_cast<Ints>(v) & mask);
}

SCANBENCH_INLINE float total(const Floats& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

SCANBENCH_INLINE void load(const float* p, Floats& v) {
  v = *reinterpret_cast<const LooseFloats*>(p);
}

void gaussian(const float* squared, float* out) {
  Floats s, g;
  load(squared, s);
  gaussian_lanes(s, g);
  *reinterpret_cast<LooseFloats*>(out) = g;
}

FirstSums first(const CandidateArrays& candidates, const float t[3], float squared_cutoff) {
  Floats mass{}, sx{}, sy{}, sz{};
  for (int i = 0; i < candidates.count; i += kSumLanes) {
    Floats dx, dy, dz, w;
    load(candidates.x + i, dx);
    load(candidates.y + i, dy);
    load(candidates.z + i, dz);
    dx -= t[0];
    dy -= t[1];
    dz -= t[2];
    const Floats squared = dx * dx + dy * dy + dz * dz;
    gaussian_lanes(squared, w);
    masked(squared <= squared_cutoff, w);
    mass += w;
    sx += w * dx;
    sy += w * dy;
    sz += w * dz;
  }
  return {total(mass), total(sx), total(sy), total(sz)};
}

SecondSums second(const CandidateArrays& candidates, const float t[3], float squared_cutoff) {
  Floats at_cutoff;
  gaussian_lanes(Floats{} + squared_cutoff, at_cutoff);
  Floats mass{}, density{}, sx{}, sy{}, sz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (int i = 0; i < candidates.count; i += kSumLanes) {
    Floats dx, dy, dz, w;
    load(candidates.x + i, dx);
    load(candidates.y + i, dy);
    load(candidates.z + i, dz);
    dx -= t[0];
    dy -= t[1];
    dz -= t[2];
    const Floats squared = dx * dx + dy * dy + dz * dz;
    gaussian_lanes(squared, w);
    const Ints inside = squared <= squared_cutoff;
    Floats above = w - at_cutoff;
    masked(inside, above);
    masked(inside, w);
    density += above;
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

SCANBENCH_INLINE void difference(const double* p, double centre, Doubles& d) {
  d = *reinterpret_cast<const LooseDoubles*>(p) - centre;
}

/// max(0, |d| - half)
SCANBENCH_INLINE void beyond(const Doubles& d, double half, Doubles& out) {
  const Doubles o = reinterpret_cast<Doubles>(reinterpret_cast<Longs>(d) & 0x7fffffffffffffffLL) - half;
  out = reinterpret_cast<Doubles>(reinterpret_cast<Longs>(o) & (o > 0.0));
}

int select_lanes(const double* x, const double* y, const double* z, int lanes, const NearBox& box, float* out_x,
                 float* out_y, float* out_z, int found) {
  Doubles dx, dy, dz, ox, oy, oz;
  difference(x, box.centre[0], dx);
  difference(y, box.centre[1], dy);
  difference(z, box.centre[2], dz);
  if (box.period > 0) {
    const Doubles turn = Doubles{} + box.period;
    const Longs high = dz >= 0.5 * box.period;
    const Longs low = dz < -0.5 * box.period;
    dz = dz - reinterpret_cast<Doubles>(reinterpret_cast<Longs>(turn) & high) +
         reinterpret_cast<Doubles>(reinterpret_cast<Longs>(turn) & low);
  }
  beyond(dx, box.half[0], ox);
  beyond(dy, box.half[1], oy);
  beyond(dz, box.half[2], oz);
  const Longs inside = ox * ox + oy * oy + oz * oz <= box.squared_radius;
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
