// Finds rectangles from pairs of parallel segments, in the space of slope, length and distance (Lakaemper 2010, section
// 4.2, after Lagunovsky & Ablameyko 1997). The rules below are our own; only the idea was available.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align::ffs {

struct RectangleRules {
  double angle_rad = 0.2094395102393195;  ///< 12 degrees, below 30: largest deviation from parallel and from square
  double min_side_m = 0.5;                ///< smallest distance of two parallel sides
  double min_length_ratio = 0.5;          ///< smallest ratio of the shorter to the longer of two parallel sides
  double misfit = 0.25;   ///< largest relative deviation of lengths from separations, and of the centres
  double apart_m = 0.75;  ///< of two rectangles whose centres are nearer, the less certain is dropped
  double min_certainty = 0.5;
};

struct Rectangle {
  std::array<Vec2, 4> corners;  ///< counter-clockwise
  double certainty = 0.0;  ///< 0 .. 1: share of the perimeter that was seen times the cosines of the angular deviations

  Vec2 centre() const { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
};

/// Combines two pairs of nearly parallel segments that are nearly perpendicular to each other. Each pair is as long as
/// the other pair is apart, and both have the same centre, within the tolerances. Sorted by decreasing certainty; the
/// result does not depend on the order of the segments or on the frame. Segments must be finite; those without length
/// are skipped.
std::vector<Rectangle> rectangles_of(std::span<const Segment> segments, const RectangleRules& rules);

}  // namespace scanbench::align::ffs
