// The dynamic programme of the optimal extractor: the cut of a scan into lines and clutter with the shortest
// description. Objective, recursion and the condition under which its pruning is exact: docs/algorithms/optimal.md.
// Pruning after Killick, Fearnhead & Eckley, "Optimal detection of changepoints with a linear computational cost", JASA
// 2012.
#pragma once

#include <span>
#include <vector>

#include "algorithms/extract/groups.hpp"
#include "core/geometry.hpp"

namespace scanbench::extract {

/// A return as the programme sees it. A line is theta . direction = inverse range, linear in theta.
struct SegmentationPoint {
  Vec2 direction = Vec2::Zero();  ///< unit vector of the beam
  double inverse_range = 0.0;     ///< [1/m]
  double weight = 0.0;            ///< of a squared error of the inverse range: a squared error in standard deviations
  double line_cost = 0.0;         ///< code length [nats] of a return exactly on its line
  double clutter_cost = 0.0;      ///< code length of a return that is on no line
  double gap_cost = 0.0;  ///< code length of one line going on from the point before, across missing beams; infinite:
                          ///< it cannot
};

/// Code length of a line apart from its points: base + log(number of points). Grows with the points, as pruning needs.
struct LineCost {
  double base = 0.0;
  double of(int points) const;
};

struct Segmentation {
  std::vector<PointRun> lines;  ///< ascending, disjoint; points between them are clutter
  double cost = 0.0;            ///< of everything [nats]
};

/// Half the least weighted sum of squared errors of one line through the points: the part of a line's cost that depends
/// on the line. 0 for up to two points.
double line_misfit(std::span<const SegmentationPoint> points);

/// The cheapest cut: of all ways to cut the sequence into lines and single clutter points the one with the least
///   sum over lines of (misfit + line_cost and gap_cost of its points + LineCost) + sum over clutter of clutter_cost.
/// Ties to the earlier cut. Exact for up to `max_knots` points; longer scans are cut at blocks of equal numbers of
/// points only, as few as keep the number of blocks within it.
Segmentation optimal_segmentation(std::span<const SegmentationPoint> points, LineCost line_cost, int max_knots = 12000);

/// The same without LineCost and with at most `max_lines` lines, in O(knots^2 max_lines).
Segmentation optimal_segmentation_at_most(std::span<const SegmentationPoint> points, int max_lines,
                                          int max_knots = 2000);

}  // namespace scanbench::extract
