// A grid over many segments that finds those near a path and the distance to the nearest one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/index.hpp"

namespace scanbench {

/// A uniform grid of square cells over the segments. Each cell lists the segments that come within kMarginM of it.
/// Cells at the rim extend to infinity.
class SegmentGrid {
 public:
  static constexpr double kMarginM = 2e-3;

  /// Segments with an end that is not finite are ignored.
  explicit SegmentGrid(std::span<const Segment> segments);

  bool empty() const { return members_.empty(); }

  /// Exact distance to the nearest segment; +inf if there is none, NaN for a point that is not finite.
  double distance(const Vec2& p) const;

  /// Calls `visit(index)` for all segments that come within kMarginM of the path, and for some others, in no particular
  /// order and possibly more than once per segment. The ends of the path must be finite.
  template <class Visit>
  void for_each_near(const Segment& path, Visit visit) const {
    for_each_cell(path, 0.0, [&](std::size_t cell) {
      for (std::size_t m = cell_begin_[cell]; m < cell_begin_[cell + 1]; ++m) visit(members_[m]);
    });
  }

 private:
  int column(double x) const { return index((x - origin_.x()) / cell_m_, columns_); }
  int row(double y) const { return index((y - origin_.y()) / cell_m_, rows_); }
  static int index(double at, int count);
  std::size_t cell(int column, int row) const { return as_index(row) * as_index(columns_) + as_index(column); }
  void nearest_in_cell(const Vec2& p, int column, int row, double& best) const;

  /// Visits the cells that come within `margin` of the segment in both coordinates, row by row.
  template <class Visit>
  void for_each_cell(const Segment& segment, double margin, Visit visit) const {
    const bool up = segment.b.y() >= segment.a.y();
    const Vec2& low = up ? segment.a : segment.b;
    const Vec2& high = up ? segment.b : segment.a;
    const int first = row(low.y() - margin), last = row(high.y() + margin);
    const double slope = high.y() > low.y() ? (high.x() - low.x()) / (high.y() - low.y()) : 0.0;
    for (int r = first; r <= last; ++r) {
      // The part of the segment in this row, between the row's lower and upper edge.
      const double from = origin_.y() + r * cell_m_ - kRowMarginM - margin;
      const double to = from + cell_m_ + 2 * (kRowMarginM + margin);
      double x1 = low.x(), x2 = high.x();
      if (r > first) x1 += std::max(from - low.y(), 0.0) * slope;
      if (r < last) x2 -= std::max(high.y() - to, 0.0) * slope;
      const int end = column(std::max(x1, x2) + margin + kRowMarginM);
      for (int c = column(std::min(x1, x2) - margin - kRowMarginM); c <= end; ++c) visit(cell(c, r));
    }
  }

  static constexpr double kRowMarginM = 1e-6;  ///< much larger than rounding errors in a world of 1e5 m

  std::vector<Segment> segments_;
  Vec2 origin_ = Vec2::Zero();
  double cell_m_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::size_t> cell_begin_;  ///< cell i has members_[cell_begin_[i] .. cell_begin_[i + 1])
  std::vector<std::size_t> members_;
};

}  // namespace scanbench
