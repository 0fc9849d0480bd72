// Forces between pairs of points in lanes (Lakaemper 2010, equations 1 and 2).
#include "algorithms/align/ffs/force_kernels.hpp"

#include "core/lanes/elementary.hpp"
#include "core/lanes/lanes.hpp"

namespace scanbench::align::ffs::SCANBENCH_ISA {
namespace {

using Floats = Lanes<float, kForceLanes>;
using Ints = Lanes<std::int32_t, kForceLanes>;

SCANBENCH_INLINE bool none(Ints mask) {
  using Pairs = Lanes<long long, kForceLanes / 2>;
  const auto pairs = reinterpret_cast<Pairs>(mask);
  long long any = 0;
  for (int k = 0; k < kForceLanes / 2; ++k) any |= pairs[k];
  return any == 0;
}

SCANBENCH_INLINE void subtract(float* from, Floats v) {
  store(from, load<Floats>(from) - v);
}

/// The pairs of point i with the points at places begin .. end - 1, which all come after i.
SCANBENCH_INLINE void attract_one(const ForceArrays& p, const ForceConstants& k, int i, int begin, int end) {
  const auto x = all<Floats>(p.x[i]), y = all<Floats>(p.y[i]), c = all<Floats>(p.c[i]), s = all<Floats>(p.s[i]);
  const auto body = all<Ints>(p.body[i]);
  Floats fx{}, fy{}, stiffness{};
  for (int j = begin; j < end; j += kForceLanes) {
    const Floats dx = load<Floats>(p.x + j) - x, dy = load<Floats>(p.y + j) - y;
    const Floats squared = dx * dx + dy * dy;
    const Ints acts = (load<Ints>(p.body + j) != body) & (squared <= k.squared_cut) & first_lanes<Floats>(end - j);
    if (none(acts)) continue;  // adjacent points are often of one body; this skips half of all blocks
    const Floats product = abs(c * load<Floats>(p.c + j) + s * load<Floats>(p.s + j));  // |w w cos|
    const Floats m = masked(acts, product * exp2(squared * k.exponent));                // (2)
    const Floats inverse = reciprocal_root(squared);
    const Floats spring = m * (inverse < k.stiffest ? inverse : all<Floats>(k.stiffest));
    const Floats gx = spring * dx, gy = spring * dy;  // (1)
    fx += gx;
    fy += gy;
    stiffness += spring;
    subtract(p.fx + j, gx);  // action = reaction
    subtract(p.fy + j, gy);
    subtract(p.stiffness + j, -spring);
  }
  p.fx[i] += total(fx);
  p.fy[i] += total(fy);
  p.stiffness[i] += total(stiffness);
}

void attract(const ForceArrays& p, const ForceConstants& k, int first, int last, int begin, int end) {
  for (int i = first; i < last; ++i) attract_one(p, k, i, begin > i ? begin : i + 1, end);
}

}  // namespace

extern const ForceKernels
    kForceKernels;  // NOLINT(readability-redundant-declaration): seen by clang-tidy for one of two builds
const ForceKernels kForceKernels{.attract = attract};

}  // namespace scanbench::align::ffs::SCANBENCH_ISA
