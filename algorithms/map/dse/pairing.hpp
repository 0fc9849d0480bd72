// Restrictive pairing: children of a map segment and a scan segment each (Lakaemper, Latecki & Wolter 2005, section
// 2.1).
#pragma once

#include <span>
#include <vector>

#include "algorithms/map/dse/merging.hpp"
#include "algorithms/map/dse/strokes.hpp"

namespace scanbench::mapping::dse {

struct PairingRule {
  MergeRule merge{};
  double threshold_m = 0.002;  ///< T_p: only pairs that cost less have a child
  int most_children = 3;       ///< of one segment
  Placement placement = Placement::by_length;
  bool same_side = true;  ///< segments that were seen from opposite sides are not a pair
};

/// Two parents, by index, and their child.
struct Pairing {
  std::size_t map = 0;
  std::size_t scan = 0;
  Child child;
};

/// The accepted pairs by increasing cost, ties by index: a pair is accepted while both parents have fewer than
/// most_children. Segments of one class are never paired. `directions` are unit vectors; without any there are no
/// pairs.
std::vector<Pairing> pairings(std::span<const Stroke> map, std::span<const Stroke> scan,
                              std::span<const Vec2> directions, const PairingRule& rule);

/// A_t = C1' and C2', the segments of both that are nobody's parents, and all children. A child was created at `now`;
/// parents share their evidence equally among their children. Neighbouring pieces of a stroke that are not parents are
/// one stroke again: a vertex that made no child is of no use, and pieces in a direction that is not a main direction
/// would never be joined.
std::vector<Stroke> paired(std::span<const Stroke> map, std::span<const Stroke> scan, std::span<const Pairing> pairs,
                           int now);

}  // namespace scanbench::mapping::dse
