// Generalized polylines: ordered lists of segments whose vertices may or may not be connected (Lakaemper, Latecki &
// Wolter 2005, section 2).
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::mapping::dse {

/// A segment of a polyline, by index, and whether it is passed from b to a.
struct Link {
  std::size_t segment = 0;
  bool flipped = false;
  bool operator==(const Link&) const = default;
};
using Polyline = std::vector<Link>;

/// Groups segments: a greedy chain starts at segment 0 and always appends the unused segment with the nearest free end,
/// flipping it where its b is nearer; the chain is cut wherever the gap exceeds max_gap_m. The sum of the gaps is
/// small, not proven least; for the segments of one scan in beam order the chain is that order in almost all cases.
std::vector<Polyline> generalized_polylines(std::span<const Segment> segments, double max_gap_m);

/// Number of different vertices of the polylines: an end within joined_m of the next segment's is one with it.
int vertices(std::span<const Segment> segments, std::span<const Polyline> polylines, double joined_m);

}  // namespace scanbench::mapping::dse
