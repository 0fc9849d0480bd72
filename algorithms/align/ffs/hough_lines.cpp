// Accumulator, peaks and refit of the lines of a Hough transform.
#include "algorithms/align/ffs/hough_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "algorithms/align/parts/cell_grid.hpp"
#include "core/geometry/least_squares.hpp"
#include "core/geometry/portable_math.hpp"

namespace scanbench::align::ffs {
namespace {

constexpr int kAngles = 180;  // one degree each
constexpr int kApartDeg = 5;
constexpr int kApartCells = 5;
constexpr double kMostCellsAcross = 4096.0;  // cells are wider if the map would need more
constexpr double kRefitCells = 1.5;

std::array<Vec2, kAngles> make_normals() {
  std::array<Vec2, kAngles> normals;
  for (int k = 0; k < kAngles; ++k) {
    const auto [s, c] = portable::sincos(k * kPi / kAngles);
    normals[static_cast<std::size_t>(k)] = {c, s};
  }
  return normals;
}

struct Voter {
  float x;
  float y;
  float votes;
};

/// Merges points within cells of half a Hough cell into one voter at their mean.
std::vector<Voter> voters_of(std::span<const Vec2> points, const Vec2& origin, double step_m) {
  const CellGrid grid(points, step_m);
  std::vector<Voter> voters;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const CellGrid::Run cell = grid.cell(row, column);
      if (cell.begin == cell.end) continue;
      Vec2 sum = Vec2::Zero();
      for (std::size_t k = cell.begin; k < cell.end; ++k) sum += points[grid.order()[k]] - origin;
      const auto n = static_cast<double>(cell.end - cell.begin);
      voters.push_back({static_cast<float>(sum.x() / n), static_cast<float>(sum.y() / n), static_cast<float>(n)});
    }
  return voters;
}

class Accumulator {
 public:
  Accumulator(std::span<const Voter> voters, double step_m, double reach_m) {
    half_ = static_cast<int>(std::ceil(reach_m / step_m)) + 2;  // one spare cell on both sides for the neighbours
    across_ = 2 * half_ + 1;
    votes_.assign(static_cast<std::size_t>(kAngles) * static_cast<std::size_t>(across_), 0.0F);
    for (int k = 0; k < kAngles; ++k) {
      const Vec2& normal = normals()[static_cast<std::size_t>(k)];
      const auto cx = static_cast<float>(normal.x() / step_m), cy = static_cast<float>(normal.y() / step_m);
      const float zero = static_cast<float>(half_) + 0.5F;
      float* row = &votes_[static_cast<std::size_t>(k) * static_cast<std::size_t>(across_)];
      for (const Voter& v : voters) row[static_cast<int>(cx * v.x + cy * v.y + zero)] += v.votes;
    }
  }

  static const std::array<Vec2, kAngles>& normals() {
    static const std::array<Vec2, kAngles> table = make_normals();
    return table;
  }
  int half() const { return half_; }

  /// The votes of a cell plus half of those of its neighbours in distance, so that a line near a border is not lost. A
  /// cell at an angle outside the table is the cell of the same line with the opposite normal.
  float smoothed(int angle, int cell) const {
    if (angle < 0 || angle >= kAngles) {
      angle += angle < 0 ? kAngles : -kAngles;
      cell = -cell;
    }
    if (std::abs(cell) >= half_) return 0.0F;
    const float* at = &votes_[static_cast<std::size_t>(angle) * static_cast<std::size_t>(across_) +
                              static_cast<std::size_t>(cell + half_)];
    return at[0] + 0.5F * (at[-1] + at[1]);
  }

 private:
  int half_;
  int across_;
  std::vector<float> votes_;
};

struct Peak {
  int angle;
  int cell;
  float votes;

  bool near(const Peak& other) const {
    int turn = std::abs(angle - other.angle), shift = cell - other.cell;
    if (turn > kAngles / 2) turn = kAngles - turn, shift = cell + other.cell;
    return turn <= kApartDeg && std::abs(shift) <= kApartCells;
  }
};

std::vector<Peak> peaks_of(const Accumulator& votes, const HoughRules& rules) {
  std::vector<Peak> candidates;
  for (int angle = 0; angle < kAngles; ++angle)
    for (int cell = 1 - votes.half(); cell < votes.half(); ++cell) {
      const float v = votes.smoothed(angle, cell);
      if (v < static_cast<float>(rules.min_votes)) continue;
      const bool highest = v >= votes.smoothed(angle, cell - 1) && v >= votes.smoothed(angle, cell + 1) &&
                           v >= votes.smoothed(angle - 1, cell) && v >= votes.smoothed(angle + 1, cell);
      if (highest) candidates.push_back({angle, cell, v});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Peak& a, const Peak& b) { return a.votes > b.votes; });
  std::vector<Peak> peaks;
  for (const Peak& c : candidates) {
    if (static_cast<int>(peaks.size()) == rules.most) break;
    if (!peaks.empty() && c.votes < rules.min_certainty * static_cast<double>(peaks.front().votes)) break;
    if (std::ranges::none_of(peaks, [&](const Peak& p) { return p.near(c); })) peaks.push_back(c);
  }
  return peaks;
}

}  // namespace

std::vector<HoughLine> hough_lines(std::span<const Vec2> points, const HoughRules& rules) {
  std::vector<HoughLine> lines;
  if (points.empty()) return lines;
  Vec2 origin = Vec2::Zero();
  for (const Vec2& p : points) origin += p / static_cast<double>(points.size());
  double reach = 0.0;
  for (const Vec2& p : points) reach = std::max(reach, (p - origin).norm());
  const double step = std::max(rules.step_m, 2.0 * reach / kMostCellsAcross);
  const std::vector<Voter> voters = voters_of(points, origin, step);
  const Accumulator votes(voters, step, reach);
  for (const Peak& peak : peaks_of(votes, rules)) {
    const Vec2 normal = Accumulator::normals()[static_cast<std::size_t>(peak.angle)];
    PointMoments moments;
    for (const Voter& v : voters) {
      const Vec2 p(static_cast<double>(v.x), static_cast<double>(v.y));
      if (std::fabs(normal.dot(p) - peak.cell * step) <= kRefitCells * step)
        moments.add(p, static_cast<double>(v.votes));
    }
    const LineFit fit = fit_line(moments);
    const Vec2 fitted = fit.degenerate ? normal : fit.normal;
    const double offset = fit.degenerate ? peak.cell * step : fit.offset;
    lines.push_back({fitted, offset + fitted.dot(origin), static_cast<double>(peak.votes), 0.0});
  }
  for (HoughLine& line : lines) line.certainty = line.votes / lines.front().votes;
  return lines;
}

Segment clipped(const HoughLine& line, std::span<const Vec2> points) {
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 along = perpendicular(line.normal);
  const Vec2 middle = 0.5 * (low + high);
  const Vec2 foot = middle - (line.normal.dot(middle) - line.offset) * line.normal;
  double from = -(high - low).norm(), to = -from;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) {
      if (foot[axis] < low[axis] || foot[axis] > high[axis]) to = from;
      continue;
    }
    const double a = (low[axis] - foot[axis]) / along[axis], b = (high[axis] - foot[axis]) / along[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (to <= from) return {foot, foot};
  return {foot + from * along, foot + to * along};
}

}  // namespace scanbench::align::ffs
