// Counting sort of points into cells.
#include "algorithms/align/parts/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::align {
namespace {

constexpr double kCellsPerPoint = 4.0;
constexpr double kFewCells = 64.0;

}  // namespace

CellGrid::CellGrid(std::span<const Vec2> points, double reach) : order_(points.size()) {
  if (points.empty()) return;
  Vec2 high = points.front();
  low_ = points.front();
  for (const Vec2& p : points) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle_ = 0.5 * (low_ + high);
  const Vec2 extent = high - low_;
  const double most = kCellsPerPoint * static_cast<double>(points.size()) + kFewCells;
  // The number of cells grows with the longer side of a narrow map and with the area of other maps.
  const double cell =
      std::max({0.5 * reach, std::sqrt(2.0 * extent.x() * extent.y() / most), 2.0 * extent.maxCoeff() / most});
  inverse_cell_ = 1.0 / cell;
  around_ = static_cast<int>(std::ceil(reach * inverse_cell_));
  columns_ = static_cast<int>(extent.x() * inverse_cell_) + 1;
  rows_ = static_cast<int>(extent.y() * inverse_cell_) + 1;

  const auto cells = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_);
  begin_.assign(cells + 1, 0);
  std::vector<std::uint32_t> cell_of(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    cell_of[k] = static_cast<std::uint32_t>(row_of(points[k]) * columns_ + column_of(points[k]));
    ++begin_[cell_of[k] + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) begin_[c + 1] += begin_[c];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t k = 0; k < points.size(); ++k) order_[next[cell_of[k]]++] = static_cast<std::uint32_t>(k);
}

int CellGrid::index(double at, int count) {
  return at <= 0 ? 0 : at >= count - 1 ? count - 1 : static_cast<int>(at);
}

CellGrid::Run CellGrid::run(int row, int first, int last) const {
  first = std::max(first, 0);
  last = std::min(last, columns_ - 1);
  if (row < 0 || row >= rows_ || first > last) return {0, 0};
  const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
  return {begin_[start + static_cast<std::size_t>(first)], begin_[start + static_cast<std::size_t>(last) + 1]};
}

}  // namespace scanbench::align
