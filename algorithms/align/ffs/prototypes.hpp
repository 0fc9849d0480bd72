// Joins the segments that show one wall in different scans, which are not yet aligned, into one segment (Lakaemper
// 2010, section 4.2, figure 7).
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align::ffs {

struct PrototypeRules {
  double angle_rad = 0.17453292519943295;  ///< 10 degrees
  double distance_m = 0.2;  ///< across: largest distance of the midpoint of one from the line of the other
  double gap_m = 1.5;       ///< along: largest gap, such as a door or a part that no scan shows
};

/// Takes the segments from the longest to the shortest. Each joins the nearest prototype (across) of those that it
/// matches, or begins a new one. Then prototypes that match are joined until none match. A prototype has the
/// length-weighted mean direction and midpoint of its members and extends over all of them. O(segments * prototypes).
/// The result does not depend on the order of segments of different length. Segments must be finite; those without
/// length are skipped.
std::vector<Segment> prototypes_of(std::span<const Segment> segments, const PrototypeRules& rules);

}  // namespace scanbench::align::ffs
