// The best chains with few vertices on a grid of readings and ranges: a dynamic programme over (reading, range, number
// of vertices). docs/algorithms/polyline.md, section 2.
#pragma once

#include <span>
#include <vector>

#include "algorithms/extract/parts/scan_model.hpp"

namespace scanbench::extract {

/// A vertex of the grid.
struct GridVertex {
  int point = 0;
  double inverse_range = 0.0;
};

/// Chains of at least two vertices, in the order of their points; points between two chains are clutter. A chain
/// explains the points from its first to its last vertex.
struct GridChains {
  std::vector<std::vector<GridVertex>> chains;
  double cost = 0.0;  ///< cost of the whole description [nats]
};

/// Extra cost of a wall between neighbouring points [nats]. Such a wall explains no return between its ends, and
/// without the extra cost two chains that end there would cost the same.
inline constexpr double kBareWall = 1e-2;

/// Per point the inverse ranges that a vertex there may have: the same number, at least one, for all points.
using VertexChoices = std::vector<std::vector<double>>;

/// The cheapest description by chains with at most `max_vertices` vertices together, at `vertex_cost` each. Points on
/// chains cost `line_cost` and half the weighted squared error of the inverse range; other points are clutter. Chains
/// pay finite gap costs and do not cross infinite ones. Vertices are at every `stride`-th point, at both sides of gaps
/// and at the ends. O(points^2 choices^2 / stride^2) if `vertex_cost` > 0 and the cheapest description of any number of
/// vertices is within the limit; otherwise max_vertices times as much.
GridChains best_chains(std::span<const SegmentationPoint> points, const VertexChoices& choices, int max_vertices,
                       double vertex_cost, int stride);

/// The cheapest closed chain of `vertices` vertices, one of which is `fixed`. The chain begins there and ends there a
/// turn later (point + points.size()), without clutter. The points must cover a full turn. No chain if none exists.
GridChains best_closed_chain(std::span<const SegmentationPoint> points, const VertexChoices& choices, int vertices,
                             int stride, const GridVertex& fixed);

}  // namespace scanbench::extract
