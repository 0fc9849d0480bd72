// Construction of the grid: sorts the points into columns.
#include "algorithms/merge/parts/point_grid.hpp"

#include <limits>

#include "core/error.hpp"

namespace scanbench::merge {

PointGrid::PointGrid(std::span<const Vec3> points, double cell, double period)
    : inverse_cell_(1.0 / cell), period_(period) {
  SCANBENCH_ASSERT(cell > 0 && period >= 0 && points.size() < std::numeric_limits<std::uint32_t>::max());
  struct Key {
    std::int64_t iy;
    std::int64_t ix;
    std::uint32_t index;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) keys.push_back({cell_of(points[i].y()), cell_of(points[i].x()), i});
  std::sort(keys.begin(), keys.end());

  x_.reserve(points.size());
  y_.reserve(points.size());
  z_.reserve(points.size());
  index_.reserve(points.size());
  for (const Key& key : keys) {
    if (columns_.empty() || columns_.back().iy != key.iy || columns_.back().ix != key.ix)
      columns_.push_back({key.iy, key.ix, index_.size(), index_.size()});
    columns_.back().end = index_.size() + 1;
    x_.push_back(points[key.index].x());
    y_.push_back(points[key.index].y());
    z_.push_back(points[key.index].z());
    index_.push_back(key.index);
  }
}

}  // namespace scanbench::merge
