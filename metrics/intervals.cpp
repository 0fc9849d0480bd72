// Intervals on a line.
#include "metrics/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanbench::metrics {
namespace {

/// Cuts the interval down to where low <= value + slope * t <= high. False if nothing is left.
bool clip(Interval& t, double value, double slope, double low, double high) {
  if (slope == 0) return value >= low && value <= high;
  const auto [first, last] = std::minmax({(low - value) / slope, (high - value) / slope});
  t.low = std::max(t.low, first);
  t.high = std::min(t.high, last);
  return t.low <= t.high;
}

}  // namespace

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

double total_length(const std::vector<Interval>& united) {
  double sum = 0.0;
  for (const Interval& i : united) sum += i.length();
  return sum;
}

double common_length(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  double sum = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    sum += std::max(0.0, std::min(a[i].high, b[j].high) - std::max(a[i].low, b[j].low));
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
  Interval near{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
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
  near.low = std::max(near.low, whole.low);
  near.high = std::min(near.high, whole.high);
  if (!(near.high > near.low)) return std::nullopt;
  return near;
}

}  // namespace scanbench::metrics
