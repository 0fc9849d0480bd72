// Cross products of points with a chord in lanes. Nothing here is a function that the linker could merge between the
// two builds.
#include "algorithms/extract/parts/chord_kernels.hpp"

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

constexpr int kLanes = 4;
typedef double Doubles __attribute__((vector_size(8 * kLanes)));                              // NOLINT
typedef long long Longs __attribute__((vector_size(8 * kLanes)));                             // NOLINT
typedef double LooseDoubles __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));  // NOLINT

double farthest(const double* points, int count, const double a[2], const double chord[2], int* index) {
  Doubles best = Doubles{} - 1.0;
  Longs best_index{};
  Longs here = {0, 2, 1, 3};  // the order of lanes for which pairs need no instruction across the register's halves
  int k = 0;
  const double* p = points;
  for (; k + kLanes <= count; k += kLanes, p += 2L * kLanes) {
    const Doubles first = *reinterpret_cast<const LooseDoubles*>(p);
    const Doubles second = *reinterpret_cast<const LooseDoubles*>(p + kLanes);
    const Doubles x = __builtin_shufflevector(first, second, 0, 4, 2, 6);
    const Doubles y = __builtin_shufflevector(first, second, 1, 5, 3, 7);
    const Doubles across = chord[0] * (y - a[1]) - chord[1] * (x - a[0]);
    const Longs distance = reinterpret_cast<Longs>(across) & 0x7fffffffffffffffLL;
    const Longs farther = reinterpret_cast<Doubles>(distance) > best;
    best = reinterpret_cast<Doubles>((distance & farther) | (reinterpret_cast<Longs>(best) & ~farther));
    best_index = (here & farther) | (best_index & ~farther);
    here += kLanes;
  }
  double most = best[0];
  long long at = best_index[0];
  for (int lane = 1; lane < kLanes; ++lane)
    if (best[lane] > most || (best[lane] == most && best_index[lane] < at)) {
      most = best[lane];
      at = best_index[lane];
    }
  for (; k < count; ++k, p += 2) {
    const double across = chord[0] * (p[1] - a[1]) - chord[1] * (p[0] - a[0]);
    const double distance = across < 0 ? -across : across;
    if (distance > most) {
      most = distance;
      at = k;
    }
  }
  *index = static_cast<int>(at);
  return most;
}

}  // namespace

extern const ChordKernels
    kChordKernels;  // NOLINT(readability-redundant-declaration): seen by clang-tidy for one of two builds
const ChordKernels kChordKernels{.farthest = farthest};

}  // namespace scanbench::extract::SCANBENCH_ISA
