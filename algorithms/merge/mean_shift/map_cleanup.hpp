// After merging (Lakaemper 2009, section V.A and caption of figure 3): joining abutting pieces of one wall, trimming
// what overshoots an intersection, erasing short lines that too few scan points support.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::merge {

/// A line of the map in the making and the pieces that went into it.
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

/// Unites neighbours until none are left that fit. The joined line is the orthogonal least-squares line of the end
/// points, each weighted with its line's length, and reaches as far as they do. The result keeps the order of first
/// members and the cluster of the longest.
std::vector<DraftLine> join_neighbours(std::vector<DraftLine> lines, const JoinTolerance& rules);

/// Cuts both lines of each crossing back to the crossing where the shorter rest is at most `overshoot_m` long and less
/// than half of the line; of several crossings near one end the outermost counts. Lines that meet at less than 10
/// degrees do not cut each other. All cuts refer to the lines as given.
void trim_overshoots(std::vector<DraftLine>& lines, double overshoot_m);

struct RequiredSupport {
  double distance_m;    ///< a point this near, with its projection inside the line, supports it
  double min_length_m;  ///< longer lines stay whatever their support
  double min_points_per_m;
};

/// True per line: shorter than min_length_m and with less than min_points_per_m. Points that are not finite are passed
/// over.
std::vector<bool> lacks_support(std::span<const DraftLine> lines, std::span<const Vec2> points,
                                const RequiredSupport& rules);

}  // namespace scanbench::merge
