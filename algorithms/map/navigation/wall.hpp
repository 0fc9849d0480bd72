// A segment of the navigation map: the points that support it, as moments, and its extent (Siadat et al. 1997, sections
// 6 and 7).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/least_squares.hpp"

namespace scanbench::mapping::navigation {

/// The line is the orthogonal least-squares fit of all points merged into the wall, its ends are the outermost
/// projections of the segments merged into it; the free side is on the left of a -> b.
struct MapWall {
  Segment segment;
  PointMoments moments;
  int members = 1;  ///< scan lines
  int points = 0;   ///< scan points
};

/// A wall from a segment and its points. Without points the segment's ends count as two.
MapWall wall_of(const Segment& segment, std::span<const Vec2> points);

struct UniteRule {
  double angle_rad = 0.175;  ///< largest difference of direction
  double offset_m = 0.10;    ///< largest distance of either segment's ends from the other one's line, over the overlap
  double gap_m = 0.20;       ///< largest gap between the projections on the longer one
};

/// True if two walls are one surface: seen from the same side, nearly parallel, near each other across, overlapping or
/// nearly touching along.
bool same_surface(const Segment& s, const Segment& t, const UniteRule& rule);

/// One wall from two: moments add up, the line is fitted again, the extent is the union of both projections.
MapWall united(const MapWall& s, const MapWall& t);

}  // namespace scanbench::mapping::navigation
