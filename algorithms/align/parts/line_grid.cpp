// Construction of the grid: enters each line in the cells within its reach.
#include "algorithms/align/parts/line_grid.hpp"

#include <algorithm>
#include <numbers>

namespace scanbench::align {
namespace {

constexpr double kSmallestCellM = 0.5;
constexpr double kMostCellsAlong = 100.0;

}  // namespace

LineGrid::LineGrid(const PartnerRules& widest, double longest_m) : across_m_(widest.gate_m), along_m_(widest.margin_m) {
  // Up to 1e9 m, cell numbers are below 2^31, which the keys require.
  inverse_cell_ = 1.0 / std::max(kSmallestCellM, (longest_m + 2.0 * (across_m_ + along_m_)) / kMostCellsAlong);
}

void LineGrid::add(int scan, const Pose2& world_from_sensor, std::span<const Segment> lines) {
  for (const Segment& seen : lines) {
    const Segment s = world_from_sensor * seen;
    if (!in_range(s.a) || !in_range(s.b)) continue;
    const PlacedLine line{s.a, s.direction(), s.length(), scan};
    if (line.length > 0) add(line);
  }
}

void LineGrid::add(const PlacedLine& line) {
  // A cell is replaced by the circle around it. This adds some cells that the line does not reach and omits none.
  const double around = 0.5 * std::numbers::sqrt2 / inverse_cell_;
  const double across = across_m_ + around;
  const double along = along_m_ + around;
  const Vec2 end = line.start + line.length * line.direction;
  const Vec2 reach = Vec2::Constant(across_m_ + along_m_);
  const Vec2 low = line.start.cwiseMin(end) - reach;
  const Vec2 high = line.start.cwiseMax(end) + reach;
  for (std::int64_t iy = cell_of(low.y()); iy <= cell_of(high.y()); ++iy)
    for (std::int64_t ix = cell_of(low.x()); ix <= cell_of(high.x()); ++ix) {
      const Vec2 centre = Vec2(static_cast<double>(ix) + 0.5, static_cast<double>(iy) + 0.5) / inverse_cell_;
      const double u = line.along(centre);
      if (std::abs(line.before(centre)) <= across && u >= -along && u <= line.length + along)
        cells_[key_of(ix, iy)].push_back(line);
    }
}

}  // namespace scanbench::align
