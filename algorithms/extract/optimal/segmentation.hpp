// The cut of a scan into lines and clutter with the shortest description: a dynamic programme.
// docs/algorithms/optimal.md, sections 2 to 4, has the objective, the recurrence and the condition under which its
// pruning is exact. Pruning after Killick, Fearnhead & Eckley, "Optimal detection of changepoints with a linear
// computational cost", JASA 2012.
#pragma once

#include <span>
#include <vector>

#include "algorithms/extract/parts/groups.hpp"
#include "algorithms/extract/parts/scan_model.hpp"

namespace scanbench::extract {

/// Code length of a line without its points: base + log(number of points). Pruning needs that it never decreases with
/// the number of points.
struct LineCost {
  double base = 0.0;
  double of(int points) const;
};

struct Segmentation {
  std::vector<PointRun> lines;  ///< ascending, disjoint; points between them are clutter
  double cost = 0.0;            ///< cost of all points and lines [nats]
};

/// Half the least weighted sum of squared errors of one line through the points: the part of a line's cost that depends
/// on the line. 0 for up to two points.
double line_misfit(std::span<const SegmentationPoint> points);

/// The cut with the least cost among all cuts of the sequence into lines and single clutter points:
///   sum over lines of (misfit + line_cost and gap_cost of its points + LineCost) + sum over clutter of clutter_cost.
/// Of equal costs the earlier cut wins. Exact for up to `max_knots` points. Longer scans are cut only between blocks of
/// equally many points, with the smallest block that keeps the number of blocks within `max_knots`.
Segmentation optimal_segmentation(std::span<const SegmentationPoint> points, LineCost line_cost, int max_knots = 12000);

/// The same without LineCost and with at most `max_lines` lines, in O(knots^2 max_lines).
Segmentation optimal_segmentation_at_most(std::span<const SegmentationPoint> points, int max_lines,
                                          int max_knots = 2000);

}  // namespace scanbench::extract
