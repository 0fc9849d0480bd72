// Nearest segment by rings of grid cells around the point.
#include "metrics/segment_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostCellsPerSide = 512;

}  // namespace

SegmentGrid::SegmentGrid(std::span<const Segment> segments) {
  Vec2 low = Vec2::Constant(kInfinity);
  Vec2 high = -low;
  for (const Segment& s : segments) {
    if (!s.a.allFinite() || !s.b.allFinite()) continue;
    segments_.push_back(s);
    low = low.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  if (segments_.empty()) return;
  const Vec2 size = high - low;
  // About four cells a segment: most cells then hold none or a few.
  const double wanted = std::sqrt(size.prod() / (4.0 * static_cast<double>(segments_.size())));
  cell_ = std::max({wanted, size.maxCoeff() / kMostCellsPerSide, 1e-6});
  origin_ = low;
  columns_ = 1 + static_cast<int>(size.x() / cell_);
  rows_ = 1 + static_cast<int>(size.y() / cell_);

  const auto cells_of = [&](const Segment& s, auto&& visit) {
    // Row by row, the columns between the points where the segment enters and leaves the row, one cell wider than
    // that so that rounding cannot lose any.
    const int r0 = row(std::min(s.a.y(), s.b.y()));
    const int r1 = row(std::max(s.a.y(), s.b.y()));
    for (int r = r0; r <= r1; ++r) {
      double x0 = std::min(s.a.x(), s.b.x());
      double x1 = std::max(s.a.x(), s.b.x());
      const Vec2 d = s.b - s.a;
      // A segment that is almost level would put the crossings anywhere.
      if (std::fabs(d.y()) > 1e-6 * cell_) {
        const double bottom = s.a.x() + (origin_.y() + r * cell_ - s.a.y()) * (d.x() / d.y());
        const double top = s.a.x() + (origin_.y() + (r + 1) * cell_ - s.a.y()) * (d.x() / d.y());
        x0 = std::max(x0, std::min(bottom, top));
        x1 = std::min(x1, std::max(bottom, top));
      }
      const int c1 = std::min(column(x1) + 1, columns_ - 1);
      for (int c = std::max(column(x0) - 1, 0); c <= c1; ++c)
        visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c));
    }
  };
  cell_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Segment& s : segments_) cells_of(s, [&](std::size_t cell) { ++cell_begin_[cell + 1]; });
  for (std::size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
  members_.resize(cell_begin_.back());
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t k = 0; k < segments_.size(); ++k)
    cells_of(segments_[k], [&](std::size_t cell) { members_[next[cell]++] = k; });
}

int SegmentGrid::column(double x) const {
  return static_cast<int>(std::clamp((x - origin_.x()) / cell_, 0.0, columns_ - 1.0));
}

int SegmentGrid::row(double y) const {
  return static_cast<int>(std::clamp((y - origin_.y()) / cell_, 0.0, rows_ - 1.0));
}

void SegmentGrid::visit_cell(const Vec2& p, int c, int r, double& best) const {
  const std::size_t cell =
      static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  for (std::size_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i)
    best = std::min(best, scanbench::distance(p, segments_[members_[i]]));
}

double SegmentGrid::distance(const Vec2& p) const {
  if (!p.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  double best = kInfinity;
  if (empty()) return best;
  const int c = column(p.x());
  const int r = row(p.y());
  // For a point outside the grid, whatever lies k cells away from its nearest cell is at least hypot(outside, k cells)
  // away, because the grid is convex. An allowance of a thousandth of a cell covers rounding at cell borders.
  const Vec2 corner = origin_ + cell_ * Vec2(columns_, rows_);
  const double outside = (p - p.cwiseMax(origin_).cwiseMin(corner)).norm();
  const int rings = std::max({c, columns_ - 1 - c, r, rows_ - 1 - r});
  for (int k = 0; k <= rings; ++k) {
    if (k > 0 && best <= std::hypot(outside, (k - 1.001) * cell_)) break;
    const int c0 = std::max(c - k, 0);
    const int c1 = std::min(c + k, columns_ - 1);
    for (int y = std::max(r - k, 0); y <= std::min(r + k, rows_ - 1); ++y) {
      if (y == r - k || y == r + k) {
        for (int x = c0; x <= c1; ++x) visit_cell(p, x, y, best);
      } else {
        if (c - k >= 0) visit_cell(p, c - k, y, best);
        if (c + k < columns_) visit_cell(p, c + k, y, best);
      }
    }
  }
  return best;
}

}  // namespace scanbench::metrics
