// Intervals on a line, and which part of one segment lies near another.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::metrics {

struct Interval {
  double low = 0.0;
  double high = 0.0;
  double length() const { return high - low; }
};

/// The union of the intervals: in order, disjoint. Those closer than `gap` are joined across it.
std::vector<Interval> unite(std::vector<Interval> intervals, double gap = 0.0);

double total_length(const std::vector<Interval>& united);

/// Length of the intersection of two unions.
double common_length(const std::vector<Interval>& a, const std::vector<Interval>& b);

/// The part of `probe` (metres from probe.a) whose points are no further than `distance` from `target`. It is one
/// interval, because the points near a segment form a convex set. Absent if it is empty or the probe has no length.
std::optional<Interval> part_near(const Segment& probe, const Segment& target, double distance);

}  // namespace scanbench::metrics
