// The point of a run farthest from the line through the run's end points: a step of IEPF, split-and-merge, EM and
// Kovesi's lineseg.
#pragma once

#include <span>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// The farthest point, strictly inside the run. The squared distance is kept as a fraction, so that comparisons need no
/// square root and no division.
struct Farthest {
  int index = -1;
  double numerator2 = 0.0;    ///< squared distance times denominator2
  double denominator2 = 1.0;  ///< squared length of the chord; 1 if the ends coincide

  bool exceeds(double distance_m) const { return numerator2 > distance_m * distance_m * denominator2; }
  double distance() const;
};

/// Distances are to the infinite line through the two end points, or to the first point if the ends coincide (a closed
/// contour), as in Kovesi's maxlinedev. Of equal distances the lowest index wins. The run must have at least three
/// points.
Farthest farthest_from_chord(std::span<const Vec2> points, const PointRun& run);

}  // namespace scanbench::extract
