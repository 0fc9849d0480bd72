// One pass of cross products: no trigonometry, no division.
#include "algorithms/extract/chord.hpp"

#include <cmath>

#include "core/error.hpp"

namespace scanbench::extract {
namespace {

// Ends nearer than this count as one point: far below the resolution of any scanner.
constexpr double kCoincident_m = 1e-9;

}  // namespace

double Farthest::distance() const {
  return std::sqrt(numerator2 / denominator2);
}

Farthest farthest_from_chord(std::span<const Vec2> points, const PointRun& run) {
  SCANBENCH_ASSERT(run.last - run.first >= 2);
  const auto first = static_cast<std::size_t>(run.first);
  const auto last = static_cast<std::size_t>(run.last);
  const Vec2 a = points[first];
  const Vec2 chord = points[last] - a;
  const double length2 = chord.squaredNorm();
  Farthest far;
  std::size_t index = first + 1;
  double best = -1.0;
  if (length2 > kCoincident_m * kCoincident_m) {
    for (std::size_t k = first + 1; k < last; ++k) {
      const double d = std::fabs(chord.x() * (points[k].y() - a.y()) - chord.y() * (points[k].x() - a.x()));
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
