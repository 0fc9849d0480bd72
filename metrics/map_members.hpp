// The origin of the lines of a merged map: which surfaces their members, the scan lines merged into them, are on.
#pragma once

#include <map>
#include <vector>

#include "metrics/metric.hpp"
#include "metrics/walls/surfaces.hpp"

namespace scanbench::metrics {

/// Members of a map line by surface; key -1: members on no surface.
using MemberCounts = std::map<int, int>;

/// Per line of result.map the number of its members on each surface. A scan line belongs to the surface that most of
/// its beams hit (ties: the lower index). In a run of lines without beams it belongs to the nearest surface whose
/// direction differs by at most `max_angle_rad`, at the line's true place. No counts at all if the result does not say
/// which scan lines went into which map line.
std::vector<MemberCounts> members_by_surface(const MetricInput& input, const Surfaces& surfaces, double max_angle_rad);

}  // namespace scanbench::metrics
