// Cleaning of the merged map (Lakaemper 2009, section V.A and caption of figure 3): joins abutting pieces of a wall,
// trims overshoots at intersections, and finds short lines that too few scan points support.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::merge {

/// A line of the unfinished map, and the pieces that were merged into it.
struct DraftLine {
  Segment segment;
  std::vector<int> pieces;  ///< ascending
  int cluster = -1;
};

struct JoinTolerance {
  double angle_rad;    ///< largest difference of direction
  double deviation_m;  ///< largest distance of the four end points from the joined line
  double gap_m;        ///< largest gap along it
};

/// Unites neighbours until no pair is within the tolerance. The joined line is the orthogonal least-squares line of the
/// end points, each weighted with its line's length, and extends over all of them. It takes the place of its first
/// member and the cluster of its longest.
std::vector<DraftLine> join_neighbours(std::vector<DraftLine> lines, const JoinTolerance& rules);

/// Shortens the lines at their crossings: the shorter part beyond a crossing is removed if it is at most `overshoot_m`
/// long and less than half of the line. Of several crossings near one end the outermost counts. Lines that meet at less
/// than 10 degrees do not shorten each other. All crossings are those of the lines as given.
void trim_overshoots(std::vector<DraftLine>& lines, double overshoot_m);

struct RequiredSupport {
  double distance_m;    ///< largest distance of a supporting point, whose projection is inside the line
  double min_length_m;  ///< lines of at least this length need no support
  double min_points_per_m;
};

/// For each line: true if it is shorter than min_length_m and has fewer supporting points than min_points_per_m. Points
/// that are not finite are skipped.
std::vector<bool> lacks_support(std::span<const DraftLine> lines, std::span<const Vec2> points,
                                const RequiredSupport& rules);

}  // namespace scanbench::merge
