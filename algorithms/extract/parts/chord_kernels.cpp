// Cross products of points with a chord in lanes.
#include "algorithms/extract/parts/chord_kernels.hpp"

#include "core/lanes/lanes.hpp"

namespace scanbench::extract::SCANBENCH_ISA {
namespace {

constexpr int kChordLanes = 4;
using FourDoubles = Lanes<double, kChordLanes>;
using FourLongs = Mask<FourDoubles>;

double farthest(const double* points, int count, const double a[2], const double chord[2], int* index) {
  auto best = all<FourDoubles>(-1.0);
  FourLongs best_index{};
  FourLongs here = {0, 2, 1, 3};  // the order of lanes for which pairs need no instruction across the register's halves
  int k = 0;
  const double* p = points;
  for (; k + kChordLanes <= count; k += kChordLanes, p += 2L * kChordLanes) {
    const auto first = load<FourDoubles>(p);
    const auto second = load<FourDoubles>(p + kChordLanes);
    const FourDoubles x = __builtin_shufflevector(first, second, 0, 4, 2, 6);
    const FourDoubles y = __builtin_shufflevector(first, second, 1, 5, 3, 7);
    const FourDoubles across = chord[0] * (y - a[1]) - chord[1] * (x - a[0]);
    const FourDoubles distance = abs(across);
    const FourLongs farther = distance > best;
    best = select(farther, distance, best);
    best_index = select(farther, here, best_index);
    here += kChordLanes;
  }
  double most = best[0];
  long long at = best_index[0];
  for (int lane = 1; lane < kChordLanes; ++lane)
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
