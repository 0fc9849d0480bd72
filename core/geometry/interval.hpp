// Intervals on a line, segments projected to them, and the part of one segment that is near another.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// The numbers from low to high, mostly metres along a line. Empty if high < low.
struct Interval {
  double low = 0.0;
  double high = 0.0;
  double length() const { return high - low; }
  bool operator==(const Interval&) const = default;
};

/// The projection of a segment on the axis through `origin` with the unit vector `along`, in metres from `origin`.
Interval projection(const Segment& segment, const Vec2& origin, const Vec2& along);

/// The common part of two intervals; high < low if they are apart.
Interval intersection(const Interval& a, const Interval& b);

/// The union of the intervals: sorted, disjoint, without intervals of length zero. Intervals closer than `gap` are
/// joined across it.
std::vector<Interval> unite(std::vector<Interval> intervals, double gap = 0.0);

/// Sum of the lengths of a union.
double total_length(std::span<const Interval> united);

/// Length of the intersection of two unions.
double common_length(std::span<const Interval> a, std::span<const Interval> b);

/// The part of `probe` (metres from probe.a) whose points are no further than `distance` from `target`. It is one
/// interval, because the points near a segment form a convex set. Absent if it is empty or the probe has no length.
std::optional<Interval> part_near(const Segment& probe, const Segment& target, double distance);

}  // namespace scanbench
