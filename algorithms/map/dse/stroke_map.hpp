// The map of discrete segment evolution: strokes that come and go, found by place and by age.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/map/dse/main_directions.hpp"
#include "algorithms/map/dse/strokes.hpp"
#include "core/geometry/segment_index.hpp"

namespace scanbench::mapping::dse {

/// Strokes numbered in the order of their insertion. A step costs what the strokes near it cost, however many there are
/// elsewhere.
class StrokeMap {
 public:
  std::size_t size() const { return strokes_.size(); }
  const std::map<std::size_t, Stroke>& strokes() const { return strokes_; }

  /// Returns the stroke's number.
  std::size_t insert(const Stroke& stroke);
  void erase(std::size_t number);

  /// Numbers of the strokes whose boxes come within `reach_m` of that of any segment, ascending.
  std::vector<std::size_t> near(std::span<const Segment> segments, double reach_m) const {
    return index_.near(segments, reach_m);
  }

  /// Histogram of the directions of strokes that were created at `since` or later.
  DirectionHistogram recent_directions(int since) const;

 private:
  std::map<std::size_t, Stroke> strokes_;
  std::set<std::pair<int, std::size_t>> by_age_;
  SegmentIndex index_;
  std::size_t next_ = 0;
};

}  // namespace scanbench::mapping::dse
