// The search for the point farthest from a chord, four points at once.
//
// chord_kernels.cpp is compiled twice, for any x86-64 (namespace baseline) and for AVX2 (namespace v3). Both do the
// same IEEE operations, so both give equal bytes.
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
