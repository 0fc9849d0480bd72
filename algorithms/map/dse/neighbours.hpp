// Quick tests that spare the cost function pairs of segments that cannot be merged.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/map/dse/merging.hpp"

namespace scanbench::mapping::dse {

/// How near the bounding boxes of two segments must be for them to be a pair. Two segments on parallel walls farther
/// apart than this are different surfaces at any sensible threshold.
inline constexpr double kBoxReachM = 0.5;

/// The larger of kBoxReachM and the gap that the rule bridges.
inline double reach_of(const MergeRule& rule) {
  return std::max(kBoxReachM, rule.max_gap_m);
}

/// True if the bounding boxes of two segments come within `reach` of each other in both coordinates.
inline bool boxes_meet(const Segment& s, const Segment& t, double reach) {
  const auto meet = [reach](double a, double b, double c, double d) {
    return std::max(std::min(a, b), std::min(c, d)) - std::min(std::max(a, b), std::max(c, d)) <= reach;
  };
  return meet(s.a.x(), s.b.x(), t.a.x(), t.b.x()) && meet(s.a.y(), s.b.y(), t.a.y(), t.b.y());
}

/// True if the free sides of two segments look away from each other: two faces of a thin wall.
inline bool opposed(const Segment& s, const Segment& t) {
  return s.direction().dot(t.direction()) < 0;
}

}  // namespace scanbench::mapping::dse
