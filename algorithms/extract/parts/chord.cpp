// Search for the farthest point in one pass of cross products.
#include "algorithms/extract/parts/chord.hpp"

#include <cmath>
#include <cstddef>

#include "algorithms/extract/parts/chord_kernels.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/isa.hpp"

namespace scanbench::extract {
namespace {

// Ends closer than this coincide; it is far below the resolution of any scanner.
constexpr double kCoincident_m = 1e-9;

}  // namespace

double Farthest::distance() const {
  return std::sqrt(numerator2 / denominator2);
}

Farthest farthest_from_chord(std::span<const Vec2> points, const PointRun& run) {
  SCANBENCH_ASSERT(run.last - run.first >= 2);
  const auto first = as_index(run.first);
  const auto last = as_index(run.last);
  const Vec2& a = points[first];
  const Vec2 chord = points[last] - a;
  const double length2 = chord.squaredNorm();
  Farthest far;
  std::size_t index = first + 1;
  double best = -1.0;
  if (length2 > kCoincident_m * kCoincident_m) {
    const ChordKernels& kernels = build_for(best_isa(), baseline::kChordKernels, v3::kChordKernels);
    int nth = 0;
    best = kernels.farthest(points[first + 1].data(), run.last - run.first - 1, a.data(), chord.data(), &nth);
    index += as_index(nth);
    far.numerator2 = best * best;
    far.denominator2 = length2;
  } else {
    for (std::size_t k = first + 1; k < last; ++k) {
      const double d2 = (points[k] - a).squaredNorm();
      if (d2 > best) {
        best = d2;
        index = k;
      }
    }
    far.numerator2 = best;
  }
  far.index = static_cast<int>(index);
  return far;
}

}  // namespace scanbench::extract
