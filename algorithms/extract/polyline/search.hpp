// The best chain of few vertices on a grid: vertices at readings, a few ranges each. Dynamic programme over (reading,
// range, vertices used). docs/algorithms/polyline.md, section 2.
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
  double cost = 0.0;  ///< of everything [nats]
};

/// What a wall between neighbouring points costs more [nats]: it explains no return between its ends, and two chains
/// that end there would otherwise be as good.
inline constexpr double kBareWall = 1e-2;

/// Choices of inverse range for a vertex at each point, equally many (at least one) for all points.
using VertexChoices = std::vector<std::vector<double>>;

/// The cheapest description by chains that have at most m <= `max_vertices` vertices together, at `vertex_cost` each:
/// their points by `line_cost` and half the weighted squared error of the inverse range, other points as clutter. No
/// chain crosses an infinite gap_cost, others are paid. Vertices stand at every `stride`-th point, at both sides of
/// gaps and at the ends. O(points^2 choices^2 max_vertices / stride^2).
GridChains best_chains(std::span<const SegmentationPoint> points, const VertexChoices& choices, int max_vertices,
                       double vertex_cost, int stride);

/// The cheapest closed chain of `vertices` vertices, one of which is `fixed`: it begins there and ends there a turn
/// later (point + points.size()), without clutter. Points must go all around. No chain where there is none.
GridChains best_closed_chain(std::span<const SegmentationPoint> points, const VertexChoices& choices, int vertices,
                             int stride, const GridVertex& fixed);

}  // namespace scanbench::extract
