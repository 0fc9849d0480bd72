// Points sorted by the cells of a uniform grid. The neighbours of a point are in a few runs of consecutive points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::align {

/// Built in O(points), immutable afterwards. Points are in the order of their cells, row by row, and within a cell in
/// the given order.
class CellGrid {
 public:
  /// For neighbours within `reach` > 0. Points must be finite. Cells are half the reach wide, or wider if more than
  /// about four cells per point would be needed.
  CellGrid(std::span<const Vec2> points, double reach);

  struct Run {
    std::size_t begin;
    std::size_t end;
  };

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  /// The number of rows and columns around a cell that contain all points within the reach of a point in the cell.
  int around() const { return around_; }
  /// order()[k] is the given index of the point at place k.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Centre of the bounding box.
  const Vec2& middle() const { return middle_; }

  /// Places of the points in columns first .. last of a row; columns beyond the grid are empty.
  Run run(int row, int first, int last) const;
  Run cell(int row, int column) const { return run(row, column, column); }

  /// Cell of any point of the plane, clamped to the grid.
  int row_of(const Vec2& p) const { return index((p.y() - low_.y()) * inverse_cell_, rows_); }
  int column_of(const Vec2& p) const { return index((p.x() - low_.x()) * inverse_cell_, columns_); }

  /// Calls visit(given index) for all points within the reach of p, and for some others.
  template <class Visit>
  void for_each_near(const Vec2& p, Visit&& visit) const {
    if (order_.empty()) return;
    const double x = (p.x() - low_.x()) * inverse_cell_, y = (p.y() - low_.y()) * inverse_cell_;
    if (!(x > -around_ && x < columns_ + around_ && y > -around_ && y < rows_ + around_)) return;
    const int row = row_of(p), column = column_of(p);
    for (int r = row - around_; r <= row + around_; ++r) {
      const Run near = run(r, column - around_, column + around_);
      for (std::size_t k = near.begin; k < near.end; ++k) visit(order_[k]);
    }
  }

 private:
  static int index(double at, int count);

  Vec2 low_ = Vec2::Zero();
  Vec2 middle_ = Vec2::Zero();
  double inverse_cell_ = 1.0;
  int rows_ = 0;
  int columns_ = 0;
  int around_ = 1;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> order_;
};

}  // namespace scanbench::align
