// About as many cells as walls, and cells as large as walls: a wall lies in a few cells, a cell holds a few walls.
#include "sim/wall_grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry.hpp"

namespace scanbench::sim {

WallGrid::WallGrid(std::span<const Wall> walls) : walls_(walls) {
  if (!walls.empty()) {
    Vec2 low = walls.front().segment.a, high = low;
    double sizes = 0.0;
    for (const Wall& wall : walls) {
      const auto& [a, b] = wall.segment;
      low = low.cwiseMin(a).cwiseMin(b);
      high = high.cwiseMax(a).cwiseMax(b);
      sizes += (b - a).cwiseAbs().maxCoeff();
    }
    const auto n = static_cast<double>(walls.size());
    const Vec2 extent = high - low;
    origin_ = low;
    cell_m_ = std::max({std::sqrt(extent.x() * extent.y() / n), sizes / n, extent.maxCoeff() / n, kMarginM});
    columns_ = static_cast<int>(extent.x() / cell_m_) + 1;
    rows_ = static_cast<int>(extent.y() / cell_m_) + 1;
  }
  // First how many walls each cell has, then which: no vector per cell.
  cell_begin_.assign(cell(0, rows_) + 1, 0);
  for (const Wall& wall : walls) for_each_cell(wall.segment, kMarginM, [&](std::size_t c) { ++cell_begin_[c + 1]; });
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  members_.resize(cell_begin_.back());
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t i = 0; i < walls.size(); ++i)
    for_each_cell(walls[i].segment, kMarginM, [&](std::size_t c) { members_[next[c]++] = i; });
}

int WallGrid::index(double at, int count) {
  if (!(at > 0)) return 0;
  return at >= count ? count - 1 : static_cast<int>(at);
}

bool WallGrid::any_in_cells(int first_column, int last_column, int first_row, int last_row, const Vec2& place,
                            double distance_m) const {
  for (int r = std::max(first_row, 0); r <= std::min(last_row, rows_ - 1); ++r)
    for (int c = std::max(first_column, 0); c <= std::min(last_column, columns_ - 1); ++c)
      for (std::size_t m = cell_begin_[cell(c, r)]; m < cell_begin_[cell(c, r) + 1]; ++m)
        if (distance(place, walls_[members_[m]].segment) <= distance_m) return true;
  return false;
}

bool WallGrid::any_within(const Vec2& place, double distance_m) const {
  const int c = column(place.x()), r = row(place.y());
  const auto any = [&](int first_column, int last_column, int first_row, int last_row) {
    return any_in_cells(first_column, last_column, first_row, last_row, place, distance_m);
  };
  if (any(c, c, r, r)) return true;
  // Rings of cells about the place's own; what lies in ring k is at least k - 1 cells away.
  for (int k = 1; k < std::max(columns_, rows_) && (k - 1) * cell_m_ <= distance_m; ++k)
    if (any(c - k, c + k, r - k, r - k) || any(c - k, c + k, r + k, r + k) || any(c - k, c - k, r - k + 1, r + k - 1) ||
        any(c + k, c + k, r - k + 1, r + k - 1))
      return true;
  return false;
}

}  // namespace scanbench::sim
