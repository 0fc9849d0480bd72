// Search for the farthest point in one pass of cross products.
#include "algorithms/extract/parts/chord.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/index.hpp"

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
  const Vec2 a = points[first];
  const Vec2 chord = points[last] - a;
  const double length2 = chord.squaredNorm();
  Farthest far;
  std::size_t index = first + 1;
  double best = -1.0;
  if (length2 > kCoincident_m * kCoincident_m) {
    const auto across = [&](std::size_t k) {
      return std::fabs(chord.x() * (points[k].y() - a.y()) - chord.y() * (points[k].x() - a.x()));
    };
    std::size_t k = first + 1;
    for (; k + 4 <= last; k += 4) {  // four at a time, with one comparison against the best
      const double d0 = across(k), d1 = across(k + 1), d2 = across(k + 2), d3 = across(k + 3);
      const double most = std::max(std::max(d0, d1), std::max(d2, d3));
      if (most > best) {
        best = most;
        index = k + (d0 == most ? 0 : d1 == most ? 1 : d2 == most ? 2 : 3);  // of equal ones the lowest index
      }
    }
    for (; k < last; ++k) {
      const double d = across(k);
      if (d > best) {
        best = d;
        index = k;
      }
    }
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
