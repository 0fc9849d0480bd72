// Finds lines with many points of the map by the Hough transform (Hough 1962; Duda & Hart 1972), with which Lakaemper
// 2010, section 4.1, finds the lines of a virtual scan.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align::ffs {

struct HoughRules {
  double step_m = 0.1;         ///< width of a cell in distance
  double min_certainty = 0.3;  ///< smallest ratio of the votes of a line to the votes of the strongest line
  double min_votes = 40.0;
  int most = 8;
};

struct HoughLine {
  Vec2 normal;       ///< unit
  double offset;     ///< normal . p = offset on the line
  double votes;      ///< votes of its cell plus half of those of both neighbours in distance
  double certainty;  ///< ratio of the votes to those of the strongest line
};

/// Every point votes for the lines through it in steps of one degree. Peaks are taken by decreasing votes; a peak
/// within five degrees and five cells of a stronger one is skipped. Each line is then refitted (total least squares) to
/// the points within 1.5 cells of it. Points must be finite. Points within half a cell vote together from their mean,
/// which changes the votes only for points at most that far from the border of a cell.
std::vector<HoughLine> hough_lines(std::span<const Vec2> points, const HoughRules& rules);

/// The part of a line inside the bounding box of the points. It has no length if the line does not cross the box.
Segment clipped(const HoughLine& line, std::span<const Vec2> points);

}  // namespace scanbench::align::ffs
