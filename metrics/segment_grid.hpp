// Distance of points to the nearest of many segments.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.hpp"

namespace scanbench::metrics {

/// A uniform grid of square cells over the segments, each cell naming those that pass through it.
class SegmentGrid {
 public:
  /// Segments with an end that is not finite are passed over.
  explicit SegmentGrid(std::span<const Segment> segments);

  bool empty() const { return segments_.empty(); }
  /// Exact distance to the nearest segment; +inf if there is none, NaN for a point that is not finite.
  double distance(const Vec2& p) const;

 private:
  int column(double x) const;
  int row(double y) const;
  void visit_cell(const Vec2& p, int column, int row, double& best) const;

  std::vector<Segment> segments_;
  Vec2 origin_ = Vec2::Zero();
  double cell_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::size_t> cell_begin_;  ///< of cell i: members_[cell_begin_[i] .. cell_begin_[i + 1])
  std::vector<std::size_t> members_;
};

}  // namespace scanbench::metrics
