// Keeps the strokes, their index by place and their order by age together.
#include "algorithms/map/dse/stroke_map.hpp"

namespace scanbench::mapping::dse {

std::size_t StrokeMap::insert(const Stroke& stroke) {
  const std::size_t number = next_++;
  strokes_.emplace(number, stroke);
  by_age_.emplace(stroke.created, number);
  index_.insert(number, stroke.segment);
  return number;
}

void StrokeMap::erase(std::size_t number) {
  const auto found = strokes_.find(number);
  if (found == strokes_.end()) return;
  index_.erase(number, found->second.segment);
  by_age_.erase({found->second.created, number});
  strokes_.erase(found);
}

DirectionHistogram StrokeMap::recent_directions(int since) const {
  DirectionHistogram histogram;
  for (auto it = by_age_.lower_bound({since, 0}); it != by_age_.end(); ++it)
    histogram.add(strokes_.at(it->second).segment);
  return histogram;
}

}  // namespace scanbench::mapping::dse
