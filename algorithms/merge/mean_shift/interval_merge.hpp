// Merging of the segments of one cluster: projection on the cluster's line and union of overlapping intervals
// (Lakaemper 2009, section IV.D, figure 4).
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::merge {

/// Intervals at most this far apart touch [m].
inline constexpr double kTouching = 1e-9;

struct MergedSegment {
  Segment segment;                ///< in the direction (cos theta, sin theta)
  std::vector<int> contributors;  ///< indices into the projected segments, ascending
};

/// Projects the segments on the line through `origin` with direction `theta` and unites intervals that overlap, touch
/// or are at most `gap` >= 0 apart. The result is in order along the line. No segments: an empty result.
std::vector<MergedSegment> merge_on_line(std::span<const Segment> segments, const Vec2& origin, double theta_rad,
                                         double gap_m);

}  // namespace scanbench::merge
