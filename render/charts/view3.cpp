// Projects points, and draws the walls and axes of the box.
#include "render/charts/view3.hpp"

#include <algorithm>
#include <cmath>

#include "core/ticks.hpp"
#include "render/palette.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

constexpr Color kEdge{70, 70, 70};
constexpr Color kWallFill{247, 247, 247};
constexpr Color kWallGrid{222, 222, 222};
constexpr double kTickPt = 3.0;

}  // namespace

View3::View3(std::array<Axis3, 3> axes, const Camera& camera) : axes_(std::move(axes)) {
  const auto extent = [&](std::size_t i) { return axes_[i].high - axes_[i].low; };
  const double side = std::max(extent(0), extent(1));
  scale_ = {1.0 / side, 1.0 / side, camera.height / extent(2)};
  const double a = radians(camera.azimuth_deg), e = radians(camera.elevation_deg);
  right_ = {-std::sin(a), std::cos(a), 0.0};
  up_ = {-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)};
  toward_ = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

Vec3 View3::unit(const Vec3& p) const {
  return (p - Vec3(axes_[0].low, axes_[1].low, axes_[2].low)).cwiseProduct(scale_);
}

Vec3 View3::corner(const std::array<bool, 3>& high) const {
  Vec3 p;
  for (std::size_t i = 0; i < 3; ++i) p[static_cast<Eigen::Index>(i)] = high[i] ? axes_[i].high : axes_[i].low;
  return p;
}

Vec2 View3::project(const Vec3& p) const {
  const Vec3 u = unit(p);
  return {right_.dot(u), up_.dot(u)};
}

double View3::nearness(const Vec3& p) const {
  const Vec3 box = unit(corner({true, true, true}));
  const double nearest = toward_.cwiseMax(0.0).dot(box), farthest = toward_.cwiseMin(0.0).dot(box);
  return std::clamp((toward_.dot(unit(p)) - farthest) / (nearest - farthest), 0.0, 1.0);
}

std::vector<std::pair<double, std::string>> View3::ticks(int axis) const {
  const Axis3& a = axes_[static_cast<std::size_t>(axis)];
  if (!a.ticks.empty()) return a.ticks;
  std::vector<std::pair<double, std::string>> result;
  for (const Tick& t : linear_ticks(a.low, a.high, 5)) result.emplace_back(t.value, t.label);
  return result;
}

void View3::add_wall(int normal, bool high, Panel& panel) const {
  const auto n = static_cast<std::size_t>(normal), i = (n + 1) % 3, j = (n + 2) % 3;
  const auto at = [&](bool hi, bool hj) {
    std::array<bool, 3> c{};
    c[n] = high, c[i] = hi, c[j] = hj;
    return project(corner(c));
  };
  panel.items.emplace_back(Polygon{.points = {at(false, false), at(true, false), at(true, true), at(false, true)},
                                   .fill = kWallFill,
                                   .outline = Stroke{kWallGrid, 0.6, Dash::solid}});
  Lines grid{.stroke = {kWallGrid, 0.4, Dash::solid}};
  for (const std::size_t along : {i, j})
    for (const auto& [value, label] : ticks(static_cast<int>(along))) {
      std::array<bool, 3> c{};
      c[n] = high;
      Vec3 from = corner(c);
      from[static_cast<Eigen::Index>(along)] = value;
      c[along == i ? j : i] = true;
      Vec3 to = corner(c);
      to[static_cast<Eigen::Index>(along)] = value;
      grid.segments.push_back({project(from), project(to)});
    }
  panel.items.emplace_back(std::move(grid));
}

void View3::add_axis(int axis, std::array<bool, 3> at, double pt, double font_pt, Panel& panel) const {
  const auto k = static_cast<std::size_t>(axis);
  at[k] = false;
  const Vec3 low = corner(at);
  at[k] = true;
  const Vec3 high = corner(at);
  const Vec2 a = project(low), b = project(high), middle = 0.5 * (a + b);
  const Vec2 centre = project(0.5 * (corner({false, false, false}) + corner({true, true, true})));
  Vec2 out = perpendicular((b - a).normalized());  // away from the box
  if (out.dot(middle - centre) < 0) out = -out;

  Lines lines{.stroke = {kEdge, 0.6, Dash::solid}};
  lines.segments.push_back({a, b});
  double widest = 0.0;
  for (const auto& [value, label] : ticks(axis)) {
    Vec3 p = low;
    p[static_cast<Eigen::Index>(axis)] = value;
    const Vec2 q = project(p);
    lines.segments.push_back({q, q + kTickPt * pt * out});
    panel.items.emplace_back(Text{.at = q, .text = label, .offset_pt = (kTickPt + 2.0) * out, .movable = false});
    widest = std::max(widest, Font::get().width_em(label) * font_pt);
  }
  panel.items.emplace_back(std::move(lines));
  const double past_ticks = kTickPt + 5.0 + std::max(std::abs(out.x()) * widest, axis == 2 ? 0.0 : font_pt);
  const std::string& name = axes_[k].label;
  panel.items.emplace_back(
      Text{.at = middle, .text = name, .offset_pt = past_ticks * out, .movable = false, .upwards = axis == 2});
}

Panel View3::panel(double width_pt, double font_pt) const {
  Panel panel{.x = {}, .y = {}, .axes = false};
  Vec2 low(INFINITY, INFINITY), high = -low;
  for (const bool x : {false, true})
    for (const bool y : {false, true})
      for (const bool z : {false, true}) {
        const Vec2 p = project(corner({x, y, z}));
        low = low.cwiseMin(p), high = high.cwiseMax(p);
      }
  double widest = 0.0;
  for (const auto& [value, label] : ticks(2)) widest = std::max(widest, Font::get().width_em(label) * font_pt);
  panel.room = {.left = widest / font_pt + 2.4, .right = 2.0, .below = 3.2, .above = 1.0};
  const double letters_pt = (panel.room.left + panel.room.right) * font_pt;
  const double pt = (high.x() - low.x()) / std::max(width_pt - letters_pt, 0.3 * width_pt);  // units per point
  const Vec2 margin = 0.005 * (high - low);
  panel.x.range = {low.x() - margin.x(), high.x() + margin.x()};
  panel.y.range = {low.y() - margin.y(), high.y() + margin.y()};

  const bool near_x = toward_.x() > 0, near_y = toward_.y() > 0;
  add_wall(2, false, panel);  // the floor, then the walls behind
  add_wall(0, !near_x, panel);
  add_wall(1, !near_y, panel);
  add_axis(0, {false, near_y, false}, pt, font_pt, panel);
  add_axis(1, {near_x, false, false}, pt, font_pt, panel);
  add_axis(2, {right_.x() < 0, right_.y() < 0, false}, pt, font_pt, panel);  // the leftmost edge
  return panel;
}

void add_points_by_depth(const View3& view, std::span<const Vec3> points, const Points& style, Panel& panel) {
  constexpr int kSlices = 8;
  constexpr double kPalest = 0.55;
  std::array<Points, kSlices> slices;
  for (int i = 0; i < kSlices; ++i) {
    Points& slice = slices[static_cast<std::size_t>(i)];
    slice = style;
    slice.points.clear();
    slice.color = lighten(style.color, kPalest * (1.0 - static_cast<double>(i) / (kSlices - 1)));
  }
  for (const Vec3& p : points)
    if (p.allFinite())
      slices[static_cast<std::size_t>(std::min(kSlices - 1.0, std::floor(kSlices * view.nearness(p))))]
          .points.push_back(view.project(p));
  for (Points& slice : slices)
    if (!slice.points.empty()) panel.items.emplace_back(std::move(slice));
}

}  // namespace scanbench::render
