// Rectangles that pairs of parallel segments suggest, in the space of slope, length and distance (Lakaemper 2010,
// section 4.2, after Lagunovsky & Ablameyko 1997). The rules below are ours: only the idea is public.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::align::ffs {

struct RectangleRules {
  double angle_rad = 0.2094395102393195;  ///< 12 degrees, below 30: largest departure from parallel and from square
  double min_side_m = 0.5;                ///< smallest distance of two parallel sides
  double min_length_ratio = 0.5;          ///< of the shorter to the longer of two parallel sides
  double misfit = 0.25;                   ///< largest relative departure of lengths from separations, and of centres
  double apart_m = 0.75;                  ///< of two rectangles with nearer centres the less certain is dropped
  double min_certainty = 0.5;
};

struct Rectangle {
  std::array<Vec2, 4> corners;  ///< counter-clockwise
  double certainty;             ///< 0 .. 1: seen share of the perimeter times the cosines of the angular departures

  Vec2 centre() const { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
};

/// Two pairs of near-parallel segments, nearly perpendicular to each other, each as long as the other pair is apart and
/// about the same centre. By decreasing certainty; does not depend on the order of the segments or on the frame.
/// Segments must be finite; those without length are left out.
std::vector<Rectangle> rectangles_of(std::span<const Segment> segments, const RectangleRules& rules);

}  // namespace scanbench::align::ffs
