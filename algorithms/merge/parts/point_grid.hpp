// Fixed-radius neighbour search: points in the columns of a grid, the third coordinate optionally periodic.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scanbench::merge {

using Vec3 = Eigen::Vector3d;

/// The difference of two numbers from [0, period), wrapped to [-period / 2, period / 2); unchanged for period 0.
inline double wrapped(double difference, double period) {
  if (difference >= 0.5 * period) return period > 0 ? difference - period : difference;
  if (difference < -0.5 * period) return period > 0 ? difference + period : difference;
  return difference;
}

/// A number modulo the period, in [0, period); unchanged for period 0.
inline double reduced(double z, double period) {
  if (!(period > 0)) return z;
  const double r = z - period * std::floor(z / period);
  return r < period ? r : 0.0;  // a tiny negative number gives the period by rounding
}

/// Immutable after construction. Holds a sorted copy of the points in O(n) memory, independent of their extent. The
/// order in which points are visited depends on the points only.
class PointGrid {
 public:
  /// Columns of side `cell` > 0 in x and y. Coordinates must be finite and |x / cell|, |y / cell| below 2^52. With
  /// period > 0 third coordinates must be in [0, period).
  PointGrid(std::span<const Vec3> points, double cell, double period = 0.0);

  double period() const { return period_; }

  /// Calls visit(index, p - centre) for every point p within `radius` of the box centre +- half. The third component
  /// of the difference belongs to the image of p nearest to the centre.
  template <class Visit>
  void for_each_near(const Vec3& centre, const Vec3& half, double radius, Visit&& visit) const {
    const double squared_radius = radius * radius;
    for_each_run(centre, half, radius, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const double dx = x_[k] - centre.x();
        const double dy = y_[k] - centre.y();
        const double dz = wrapped(z_[k] - centre.z(), period_);
        const double ox = std::max(0.0, std::abs(dx) - half.x());
        const double oy = std::max(0.0, std::abs(dy) - half.y());
        const double oz = std::max(0.0, std::abs(dz) - half.z());
        if (ox * ox + oy * oy + oz * oz <= squared_radius) visit(std::size_t{index_[k]}, Vec3(dx, dy, dz));
      }
    });
  }

  /// Calls visit(begin, end) for runs of the sorted points that contain all points within `radius` of the box, and
  /// others. Runs of one row of columns are adjacent and come as one.
  template <class Visit>
  void for_each_run(const Vec3& centre, const Vec3& half, double radius, Visit&& visit) const {
    const std::int64_t ix_first = cell_of(centre.x() - half.x() - radius);
    const std::int64_t ix_last = cell_of(centre.x() + half.x() + radius);
    const std::int64_t iy_last = cell_of(centre.y() + half.y() + radius);
    for (std::int64_t iy = cell_of(centre.y() - half.y() - radius); iy <= iy_last; ++iy) {
      auto column = std::lower_bound(columns_.begin(), columns_.end(), std::pair(iy, ix_first),
                                     [](const Column& c, const auto& key) { return std::pair(c.iy, c.ix) < key; });
      if (column == columns_.end()) return;  // columns are sorted by row
      const std::size_t begin = column->begin;
      std::size_t end = begin;
      for (; column != columns_.end() && column->iy == iy && column->ix <= ix_last; ++column) end = column->end;
      if (end > begin) visit(begin, end);
    }
  }

  /// Coordinates of the sorted points.
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  std::span<const double> z() const { return z_; }

 private:
  struct Column {
    std::int64_t iy;
    std::int64_t ix;
    std::size_t begin;
    std::size_t end;
  };

  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v * inverse_cell_)); }

  double inverse_cell_;
  double period_;
  std::vector<Column> columns_;  ///< by (iy, ix)
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> z_;
  std::vector<std::uint32_t> index_;
};

}  // namespace scanbench::merge
