// The search for the point farthest from a chord, four points at once.
#pragma once

namespace scanbench::extract {

struct ChordKernels {
  /// The greatest |chord x (p - a)| of `count` >= 1 points, stored as x, y, x, y, ..., and in `index` the first point
  /// that has it.
  double (*farthest)(const double* points, int count, const double a[2], const double chord[2], int* index);
};

namespace baseline {
extern const ChordKernels kChordKernels;
}
namespace v3 {
extern const ChordKernels kChordKernels;
}

}  // namespace scanbench::extract
