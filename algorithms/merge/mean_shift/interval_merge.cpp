// Projection and union of intervals (Lakaemper 2009, section IV.D).
#include "algorithms/merge/mean_shift/interval_merge.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::merge {

std::vector<MergedSegment> merge_on_line(std::span<const Segment> segments, const Vec2& origin, double theta_rad,
                                         double gap_m) {
  const Vec2 along(std::cos(theta_rad), std::sin(theta_rad));
  struct Interval {
    double start;
    double end;
    int index;
  };
  std::vector<Interval> intervals;
  intervals.reserve(segments.size());
  for (const Segment& s : segments) {
    const auto [start, end] = std::minmax({along.dot(s.a - origin), along.dot(s.b - origin)});
    intervals.push_back({start, end, static_cast<int>(intervals.size())});
  }
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    return a.start != b.start ? a.start < b.start : a.index < b.index;
  });

  std::vector<MergedSegment> merged;
  for (std::size_t first = 0; first < intervals.size();) {
    double end = intervals[first].end;
    MergedSegment united;
    std::size_t k = first;
    for (; k < intervals.size() && (k == first || intervals[k].start <= end + gap_m + kTouching); ++k) {
      end = std::max(end, intervals[k].end);
      united.contributors.push_back(intervals[k].index);
    }
    united.segment = {origin + intervals[first].start * along, origin + end * along};
    std::sort(united.contributors.begin(), united.contributors.end());
    merged.push_back(std::move(united));
    first = k;
  }
  return merged;
}

}  // namespace scanbench::merge
