// Builds the grid with about four cells per segment, so that most cells hold few segments or none, and searches the
// nearest segment in rings of cells around a point.
#include "core/geometry/segment_grid.hpp"

#include <cmath>

#include "core/special_values.hpp"

namespace scanbench {
namespace {

constexpr double kMostCellsPerSide = 512;

bool finite(const Segment& s) {
  return s.a.allFinite() && s.b.allFinite();
}

}  // namespace

SegmentGrid::SegmentGrid(std::span<const Segment> segments) : segments_(segments.begin(), segments.end()) {
  Vec2 low = Vec2::Constant(kInf);
  Vec2 high = -low;
  for (const Segment& s : segments_) {
    if (!finite(s)) continue;
    low = low.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  if (low.allFinite()) {
    const Vec2 size = high - low;
    const double wanted = std::sqrt(size.prod() / (4.0 * static_cast<double>(segments_.size())));
    cell_m_ = std::max({wanted, size.maxCoeff() / kMostCellsPerSide, kMarginM});
    origin_ = low;
    columns_ = 1 + static_cast<int>(size.x() / cell_m_);
    rows_ = 1 + static_cast<int>(size.y() / cell_m_);
  }
  // The first pass counts the segments of each cell, the second one lists them: there is no vector per cell.
  const auto for_each_cell_of = [&](const Segment& s, auto&& visit) {
    if (finite(s)) for_each_cell(s, kMarginM, visit);
  };
  cell_begin_.assign(cell(0, rows_) + 1, 0);
  for (const Segment& s : segments_) for_each_cell_of(s, [&](std::size_t c) { ++cell_begin_[c + 1]; });
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  members_.resize(cell_begin_.back());
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i)
    for_each_cell_of(segments_[i], [&](std::size_t c) { members_[next[c]++] = i; });
}

int SegmentGrid::index(double at, int count) {
  if (!(at > 0)) return 0;
  return at >= count ? count - 1 : static_cast<int>(at);
}

void SegmentGrid::nearest_in_cell(const Vec2& p, int c, int r, double& best) const {
  for (std::size_t m = cell_begin_[cell(c, r)]; m < cell_begin_[cell(c, r) + 1]; ++m)
    best = std::min(best, scanbench::distance(p, segments_[members_[m]]));
}

double SegmentGrid::distance(const Vec2& p) const {
  if (!p.allFinite()) return kNaN;
  double best = kInf;
  if (empty()) return best;
  const int c = column(p.x());
  const int r = row(p.y());
  // For a point outside the grid, everything k cells away from its nearest cell is at least hypot(outside, k cells)
  // away, because the grid is convex. A tolerance of a thousandth of a cell covers rounding at cell borders.
  const Vec2 corner = origin_ + cell_m_ * Vec2(columns_, rows_);
  const double outside = (p - p.cwiseMax(origin_).cwiseMin(corner)).norm();
  const int rings = std::max({c, columns_ - 1 - c, r, rows_ - 1 - r});
  for (int k = 0; k <= rings; ++k) {
    if (k > 0 && best <= std::hypot(outside, (k - 1.001) * cell_m_)) break;
    const int c0 = std::max(c - k, 0);
    const int c1 = std::min(c + k, columns_ - 1);
    for (int y = std::max(r - k, 0); y <= std::min(r + k, rows_ - 1); ++y) {
      if (y == r - k || y == r + k) {
        for (int x = c0; x <= c1; ++x) nearest_in_cell(p, x, y, best);
      } else {
        if (c - k >= 0) nearest_in_cell(p, c - k, y, best);
        if (c + k < columns_) nearest_in_cell(p, c + k, y, best);
      }
    }
  }
  return best;
}

}  // namespace scanbench
