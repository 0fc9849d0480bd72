// The point of a run farthest from the line through its end points: the step that IEPF, split-and-merge and Kovesi's
// lineseg share.
#pragma once

#include <span>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// The farthest point, strictly inside the run; the distance as a fraction, so that no root is taken before it is asked
/// for.
struct Farthest {
  int index = -1;
  double numerator2 = 0.0;    ///< squared distance times denominator2
  double denominator2 = 1.0;  ///< squared length of the chord; 1 if the ends coincide

  bool exceeds(double distance_m) const { return numerator2 > distance_m * distance_m * denominator2; }
  double distance() const;
};

/// Distances are to the infinite line through the two end points; to the first point if the ends coincide (a closed
/// contour), as in Kovesi's maxlinedev. The lowest index wins ties. The run must have at least three points.
Farthest farthest_from_chord(std::span<const Vec2> points, const PointRun& run);

}  // namespace scanbench::extract
