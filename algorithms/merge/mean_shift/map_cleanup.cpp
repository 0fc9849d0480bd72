// Joining, trimming and support of the lines of a merged map.
#include "algorithms/merge/mean_shift/map_cleanup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/merge/parts/point_grid.hpp"
#include "core/geometry/least_squares.hpp"

namespace scanbench::merge {
namespace {

struct Box {
  double x_min;
  double x_max;
  double y_min;
  double y_max;
  std::size_t line;
};

/// Calls visit(i, j), i < j, for every pair whose bounding boxes, grown by `margin`, touch: a sweep along x.
template <class Visit>
void for_each_close_pair(const std::vector<DraftLine>& lines, double margin, Visit&& visit) {
  std::vector<Box> boxes;
  boxes.reserve(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Segment& s = lines[i].segment;
    boxes.push_back({std::min(s.a.x(), s.b.x()) - margin, std::max(s.a.x(), s.b.x()) + margin,
                     std::min(s.a.y(), s.b.y()) - margin, std::max(s.a.y(), s.b.y()) + margin, i});
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.x_min != b.x_min ? a.x_min < b.x_min : a.line < b.line; });
  std::vector<const Box*> open;
  for (const Box& box : boxes) {
    std::erase_if(open, [&](const Box* other) { return other->x_max < box.x_min; });
    for (const Box* other : open)
      if (other->y_max >= box.y_min && box.y_max >= other->y_min)
        visit(std::min(box.line, other->line), std::max(box.line, other->line));
    open.push_back(&box);
  }
}

/// The segment that replaces both, if they are within the tolerance.
std::optional<Segment> joined(const Segment& s, const Segment& t, const JoinTolerance& rules) {
  if (std::abs(wrap_direction(s.direction_angle() - t.direction_angle())) > rules.angle_rad) return std::nullopt;
  PointMoments moments;
  for (const Segment& part : {s, t}) {
    moments.add(part.a, part.length());
    moments.add(part.b, part.length());
  }
  const LineFit fit = fit_line(moments);
  if (fit.degenerate) return std::nullopt;
  for (const Vec2& p : {s.a, s.b, t.a, t.b})
    if (fit.distance(p) > rules.deviation_m) return std::nullopt;
  Vec2 along = perpendicular(fit.normal);
  if (along.y() < 0 || (along.y() == 0 && along.x() < 0)) along = -along;
  const auto at = [&](const Vec2& p) { return along.dot(p - fit.centroid); };
  const auto [s_start, s_end] = std::minmax({at(s.a), at(s.b)});
  const auto [t_start, t_end] = std::minmax({at(t.a), at(t.b)});
  if (std::max(s_start, t_start) - std::min(s_end, t_end) > rules.gap_m) return std::nullopt;
  return Segment{fit.centroid + std::min(s_start, t_start) * along, fit.centroid + std::max(s_end, t_end) * along};
}

}  // namespace

std::vector<DraftLine> join_neighbours(std::vector<DraftLine> lines, const JoinTolerance& rules) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for_each_close_pair(lines, 0.5 * rules.gap_m + rules.deviation_m, [&](std::size_t i, std::size_t j) {
      if (joined(lines[i].segment, lines[j].segment, rules)) pairs.emplace_back(i, j);
    });
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> used(lines.size(), false);
    std::vector<bool> gone(lines.size(), false);
    for (const auto& [i, j] : pairs) {
      if (used[i] || used[j]) continue;  // at most one join per line and round, because the line has moved
      DraftLine& keeper = lines[i];
      const DraftLine& other = lines[j];
      const bool other_longer = other.segment.length() > keeper.segment.length();
      keeper.segment = *joined(keeper.segment, other.segment, rules);
      if (other_longer) keeper.cluster = other.cluster;
      std::vector<int> pieces;
      std::set_union(keeper.pieces.begin(), keeper.pieces.end(), other.pieces.begin(), other.pieces.end(),
                     std::back_inserter(pieces));
      keeper.pieces = std::move(pieces);
      used[i] = used[j] = gone[j] = changed = true;
    }
    std::vector<DraftLine> left;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (!gone[i]) left.push_back(std::move(lines[i]));
    lines = std::move(left);
  }
  return lines;
}

void trim_overshoots(std::vector<DraftLine>& lines, double overshoot_m) {
  constexpr double kLeastSine = 0.17364817766693033;                 // of 10 degrees
  std::vector<std::array<double, 2>> cut(lines.size(), {0.0, 0.0});  // length to remove at a and at b
  std::vector<std::array<bool, 2>> has_cut(lines.size(), {false, false});
  const auto consider = [&](std::size_t line, double at, double length) {
    const bool near_a = at < length - at;
    const double rest = near_a ? at : length - at;
    if (rest > overshoot_m || rest >= 0.5 * length) return;
    const std::size_t end = near_a ? 0 : 1;
    if (!has_cut[line][end] || rest < cut[line][end]) cut[line][end] = rest;
    has_cut[line][end] = true;
  };
  for_each_close_pair(lines, 0.0, [&](std::size_t i, std::size_t j) {
    const Segment& s = lines[i].segment;
    const Segment& t = lines[j].segment;
    const double s_length = s.length();
    const double t_length = t.length();
    const double sine = cross(s.direction(), t.direction());
    if (std::abs(sine) < kLeastSine) return;
    const double on_s = cross(t.a - s.a, t.direction()) / sine;
    const double on_t = cross(t.a - s.a, s.direction()) / sine;
    if (on_s <= 0 || on_s >= s_length || on_t <= 0 || on_t >= t_length) return;
    consider(i, on_s, s_length);
    consider(j, on_t, t_length);
  });
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Segment& s = lines[i].segment;
    const Vec2 along = s.direction();
    s.a += cut[i][0] * along;
    s.b -= cut[i][1] * along;
  }
}

std::vector<bool> lacks_support(std::span<const DraftLine> lines, std::span<const Vec2> points,
                                const RequiredSupport& rules) {
  std::vector<Vec3> usable;
  usable.reserve(points.size());
  const double cell = 0.5 * rules.min_length_m + rules.distance_m;
  for (const Vec2& p : points)
    if (std::abs(p.x()) < 1e12 * cell && std::abs(p.y()) < 1e12 * cell) usable.emplace_back(p.x(), p.y(), 0.0);

  std::vector<bool> lacking(lines.size(), false);
  if (!(cell > 0)) return lacking;
  const PointGrid grid(usable, cell);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Segment& s = lines[i].segment;
    const double length = s.length();
    if (length >= rules.min_length_m) continue;
    const Vec2 along = s.direction();
    const Vec2 middle = s.midpoint();
    int support = 0;
    grid.for_each_near({middle.x(), middle.y(), 0.0}, Vec3::Zero(), cell, [&](std::size_t, const Vec3& d) {
      const Vec2 p = d.head<2>();
      if (std::abs(along.dot(p)) <= 0.5 * length && std::abs(cross(along, p)) <= rules.distance_m) ++support;
    });
    lacking[i] = support < rules.min_points_per_m * length;
  }
  return lacking;
}

}  // namespace scanbench::merge
