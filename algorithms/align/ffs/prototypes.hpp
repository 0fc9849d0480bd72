// One segment for the many that show a wall in different scans, not yet aligned (Lakaemper 2010, section 4.2, figure
// 7).
#pragma once

#include <span>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::align::ffs {

struct PrototypeRules {
  double angle_rad = 0.17453292519943295;  ///< 10 degrees
  double distance_m = 0.2;                 ///< across: of the midpoint of one from the line of the other
  double gap_m = 1.5;                      ///< along: a door, or what no scan shows
};

/// Longest first, each segment joins the prototype across from which it is nearest among those it matches, or begins
/// one; then prototypes that match join until none does. A prototype has the length-weighted mean direction and
/// midpoint of its members and reaches over all of them. O(segments * prototypes). Does not depend on the order of
/// segments of different length; segments must be finite, those without length are left out.
std::vector<Segment> prototypes_of(std::span<const Segment> segments, const PrototypeRules& rules);

}  // namespace scanbench::align::ffs
