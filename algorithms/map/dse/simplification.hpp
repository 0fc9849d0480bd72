// Simplification: the cheapest pair of all segments is merged until none costs less than T_s (Lakaemper, Latecki &
// Wolter 2005, section 2.1).
#pragma once

#include <span>
#include <vector>

#include "algorithms/map/dse/merging.hpp"
#include "algorithms/map/dse/strokes.hpp"

namespace scanbench::mapping::dse {

struct SimplificationRule {
  MergeRule merge{};
  double threshold_m = 0.001;  ///< T_s
  Placement placement = Placement::by_length;
  bool same_side = true;  ///< segments that were seen from opposite sides are not a pair
};

/// The strokes after all merges: those that were not merged in their order, then the remaining children in the order of
/// their making. Every merge takes the globally cheapest pair (ties: the lowest indices), so each segment has one child
/// at most and none of the remaining pairs costs less than T_s. A child was created at `now`. Costs wait in a heap from
/// which pairs of merged segments are dropped when they come up; O(n^2) box tests, O(p log p) for p near pairs.
std::vector<Stroke> simplified(std::vector<Stroke> strokes, std::span<const Vec2> directions,
                               const SimplificationRule& rule, int now);

}  // namespace scanbench::mapping::dse
