// Bounding boxes, with and without outliers, and crowded squares.
#include "render/figures/parts/view_box.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {

void set_robust_ranges(Panel& panel, const std::vector<Vec2>& points) {
  if (points.size() < 200) return;
  const auto bulk = [&](Axis& axis, int coordinate) {
    std::vector<double> v;
    for (const Vec2& p : points)
      if (std::isfinite(p[coordinate])) v.push_back(p[coordinate]);
    if (v.size() < 200) return;
    std::sort(v.begin(), v.end());
    const auto quantile = [&](double q) { return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))]; };
    const double low = quantile(0.005), high = quantile(0.995), room = 0.1 * (high - low);
    if (v.back() - v.front() > 1.6 * (high - low) && high > low)
      axis.range = {std::max(v.front(), low - room), std::min(v.back(), high + room)};
  };
  bulk(panel.x, 0);
  bulk(panel.y, 1);
}

void set_ranges_to_hold(Panel& panel, const std::vector<Vec2>& points) {
  Vec2 low(INFINITY, INFINITY), high = -low;
  for (const Vec2& p : points)
    if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!(low.x() <= high.x())) return;
  const double margin = 0.05 * std::max((high - low).maxCoeff(), 1.0);
  if (!panel.x.range) panel.x.range = {low.x() - margin, high.x() + margin};
  if (!panel.y.range) panel.y.range = {low.y() - margin, high.y() + margin};
}

void Window::set_ranges(Panel& panel) const {
  panel.x.range = {center.x() - 0.5 * side, center.x() + 0.5 * side};
  panel.y.range = {center.y() - 0.5 * side, center.y() + 0.5 * side};
}

Polyline Window::outline() const {
  const double h = 0.5 * side;
  return {.points = {center + Vec2(-h, -h), center + Vec2(h, -h), center + Vec2(h, h), center + Vec2(-h, h)},
          .stroke = {kGrey, 0.6, Dash::dashed},
          .closed = true};
}

std::optional<Window> fullest_window(std::span<const Vec2> places, double side) {
  std::optional<Window> best;
  std::ptrdiff_t most = 0;
  for (const Vec2& place : places) {
    const Window window{place, side};
    const auto held = std::ranges::count_if(places, [&](const Vec2& p) { return window.contains(p); });
    if (held > most) best = window, most = held;
  }
  if (!best) return best;
  Vec2 low = best->center, high = best->center;
  for (const Vec2& p : places)
    if (best->contains(p)) low = low.cwiseMin(p), high = high.cwiseMax(p);
  best->center = 0.5 * (low + high);
  return best;
}

std::optional<Window> square_around(std::span<const Segment> segments) {
  Vec2 low(INFINITY, INFINITY), high = -low;
  for (const Segment& s : segments)
    for (const Vec2& p : {s.a, s.b})
      if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!(low.x() <= high.x())) return std::nullopt;
  return Window{0.5 * (low + high), std::max(1.1 * (high - low).maxCoeff(), 1e-3)};
}

double extent_of(std::span<const Segment> segments) {
  const auto square = square_around(segments);
  return square ? square->side / 1.1 : 0.0;
}

}  // namespace scanbench::render
