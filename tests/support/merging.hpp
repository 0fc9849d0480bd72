// Runs segment mergers in tests.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench::support {

inline MergeResult merge(std::string_view module, const std::vector<MapLine>& lines, const ParamSet& params = {},
                         const std::vector<Vec2>& points = {}) {
  Trace silent;
  return Registry<SegmentMerger>::make(module, params)->merge({lines, points}, silent);
}

inline MapLine line(double x1, double y1, double x2, double y2) {
  return {.segment = {{x1, y1}, {x2, y2}}};
}

/// Largest distance of corresponding ends, for the order of the ends that makes it smaller.
inline double apart(const Segment& s, const Segment& t) {
  const double same = std::max((s.a - t.a).norm(), (s.b - t.b).norm());
  const double swapped = std::max((s.a - t.b).norm(), (s.b - t.a).norm());
  return std::min(same, swapped);
}

}  // namespace scanbench::support
