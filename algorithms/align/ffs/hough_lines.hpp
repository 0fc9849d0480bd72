// Lines that many points of the map lie on, wherever they are: the Hough transform (Hough 1962; Duda & Hart 1972), as
// Lakaemper 2010, section 4.1, finds the lines of a virtual scan.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::align::ffs {

struct HoughRules {
  double step_m = 0.1;         ///< width of a cell in distance
  double min_certainty = 0.3;  ///< votes of a line per votes of the strongest
  double min_votes = 40.0;
  int most = 8;
};

struct HoughLine {
  Vec2 normal;       ///< unit
  double offset;     ///< normal . p = offset on the line
  double votes;      ///< of its cell, with half of those of both neighbours in distance
  double certainty;  ///< votes per votes of the strongest line
};

/// Every point votes for the lines through it in steps of one degree; peaks by decreasing votes, none within five
/// degrees and five cells of a stronger one; each then refitted (total least squares) to the points within 1.5 cells of
/// it. Points must be finite. Points within half a cell vote together from their mean place: the votes are the same but
/// for points within that of the border of a cell.
std::vector<HoughLine> hough_lines(std::span<const Vec2> points, const HoughRules& rules);

/// The part of a line inside the bounding box of the points; without length if it does not cross.
Segment clipped(const HoughLine& line, std::span<const Vec2> points);

}  // namespace scanbench::align::ffs
