// Vertex insertion: cuts segments where the ends of the other map project to, so that parts correspond (Lakaemper,
// Latecki & Wolter 2005, section 3.1, figure 5).
#pragma once

#include <span>
#include <vector>

#include "algorithms/map/dse/strokes.hpp"

namespace scanbench::mapping::dse {

struct InsertionRule {
  double reach_m = 0.2;   ///< farthest end point that makes a vertex
  double apart_m = 0.05;  ///< a vertex nearer to another one is not inserted
};

/// Cuts `strokes` at the projections of `ends`: every end looks for its closest point on the strokes, and cuts there if
/// that is nearer than reach_m and farther than apart_m from both ends of its stroke and from other cuts. Pieces are
/// collinear, in the place and the direction of their stroke, share its evidence by length and know its index.
std::vector<Stroke> with_vertices(std::span<const Stroke> strokes, std::span<const Vec2> ends,
                                  const InsertionRule& rule);

/// Both ends of every stroke.
std::vector<Vec2> ends_of(std::span<const Stroke> strokes);

}  // namespace scanbench::mapping::dse
