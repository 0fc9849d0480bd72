// Sweeps over sorted intervals, and the intersection of a segment with the points near another one.
#include "core/geometry/interval.hpp"

#include <algorithm>
#include <cmath>

#include "core/special_values.hpp"

namespace scanbench {
namespace {

/// Cuts the interval down to where low <= value + slope * t <= high. False if nothing is left.
bool clip(Interval& t, double value, double slope, double low, double high) {
  if (slope == 0) return value >= low && value <= high;
  const auto [first, last] = std::minmax({(low - value) / slope, (high - value) / slope});
  t = intersection(t, {first, last});
  return t.low <= t.high;
}

}  // namespace

Interval projection(const Segment& segment, const Vec2& origin, const Vec2& along) {
  const auto [low, high] = std::minmax({along.dot(segment.a - origin), along.dot(segment.b - origin)});
  return {low, high};
}

Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

std::vector<Interval> unite(std::vector<Interval> intervals, double gap) {
  std::ranges::sort(intervals, {}, &Interval::low);
  std::vector<Interval> united;
  for (const Interval& i : intervals) {
    if (!(i.high > i.low)) continue;
    if (!united.empty() && i.low <= united.back().high + gap)
      united.back().high = std::max(united.back().high, i.high);
    else
      united.push_back(i);
  }
  return united;
}

double total_length(std::span<const Interval> united) {
  double sum = 0.0;
  for (const Interval& i : united) sum += i.length();
  return sum;
}

double common_length(std::span<const Interval> a, std::span<const Interval> b) {
  double sum = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    sum += std::max(0.0, intersection(a[i], b[j]).length());
    if (a[i].high < b[j].high)
      ++i;
    else
      ++j;
  }
  return sum;
}

std::optional<Interval> part_near(const Segment& probe, const Segment& target, double distance) {
  const Vec2 u = probe.direction();
  const Interval whole{0.0, probe.length()};
  Interval near{kInf, -kInf};
  const auto include = [&](const Interval& part) {
    near.low = std::min(near.low, part.low);
    near.high = std::max(near.high, part.high);
  };
  // The points near a segment are two discs and the rectangle between them.
  for (const Vec2& centre : {target.a, target.b}) {
    const double foot = u.dot(centre - probe.a);
    const double off = cross(u, centre - probe.a);
    const double half = std::sqrt(std::max(distance * distance - off * off, 0.0));
    if (std::fabs(off) <= distance) include({foot - half, foot + half});
  }
  const Vec2 v = target.direction();
  const Vec2 d = probe.a - target.a;
  Interval beside = whole;
  if (clip(beside, v.dot(d), v.dot(u), 0.0, target.length()) &&
      clip(beside, cross(v, d), cross(v, u), -distance, distance))
    include(beside);
  near = intersection(near, whole);
  if (!(near.high > near.low)) return std::nullopt;
  return near;
}

}  // namespace scanbench
