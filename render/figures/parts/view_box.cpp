// Computes bounding boxes, with and without outliers, and the most crowded square.
#include "render/figures/parts/view_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanbench::render {
namespace {

struct Interval {
  double low = INFINITY, high = -INFINITY;
  bool empty() const { return !(low <= high); }
  double length() const { return high - low; }
  void take(double v) { low = std::min(low, v), high = std::max(high, v); }
};

constexpr std::size_t kFewValues = 20;  // too few to call one of them stray

/// Shrinks the interval of sorted values at its lower end: at most two values or one in 500 are stray, if a gap of a
/// twentieth of the bulk separates them from all others and from `must`.
double without_stray_low(std::span<const double> v, const Interval& must, double bulk) {
  const std::size_t most = std::max<std::size_t>(2, v.size() / 500);
  double low = std::min(v.front(), must.low);
  for (std::size_t k = 1; k <= most && k < v.size() && v[k - 1] < must.low; ++k)
    if (const double next = std::min(v[k], must.low); next - v[k - 1] > 0.05 * bulk) low = next;
  return low;
}

Interval bulk_of(std::vector<double> v, const Interval& must) {
  Interval all = must;
  for (const double x : v) all.take(x);
  if (v.size() < kFewValues) return all;
  std::sort(v.begin(), v.end());
  const auto quantile = [&](double q) { return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))]; };
  Interval bulk = must;
  bulk.take(quantile(0.02)), bulk.take(quantile(0.98));
  std::vector<double> mirrored(v.rbegin(), v.rend());
  for (double& x : mirrored) x = -x;
  const Interval rest{without_stray_low(v, must, bulk.length()),
                      -without_stray_low(mirrored, {-must.high, -must.low}, bulk.length())};
  // Many outliers without a gap, like returns at maximum range: the range is the middle 99 %.
  const double low = quantile(0.005), high = quantile(0.995), room = 0.1 * (high - low);
  if (v.size() < 200 || rest.length() <= 1.6 * (high - low) || !(high > low)) return rest;
  return {std::max(rest.low, std::min(must.low, low - room)), std::min(rest.high, std::max(must.high, high + room))};
}

}  // namespace

void set_view(std::span<const Vec2> points, std::span<const Vec2> must_hold, Panel& panel) {
  std::array<Interval, 2> shown;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto coordinate = [axis](const Vec2& p) { return p[static_cast<Eigen::Index>(axis)]; };
    std::vector<double> values;
    for (const Vec2& p : points)
      if (p.allFinite()) values.push_back(coordinate(p));
    Interval must;
    for (const Vec2& p : must_hold)
      if (p.allFinite()) must.take(coordinate(p));
    shown[axis] = bulk_of(std::move(values), must);
  }
  if (shown[0].empty() || shown[1].empty()) return;
  const double margin = 0.05 * std::max({shown[0].length(), shown[1].length(), 1.0});
  panel.x.range = {shown[0].low - margin, shown[0].high + margin};
  panel.y.range = {shown[1].low - margin, shown[1].high + margin};
}

std::vector<Vec2> ends_of(std::span<const Segment> segments) {
  std::vector<Vec2> ends;
  ends.reserve(2 * segments.size());
  for (const Segment& s : segments) ends.insert(ends.end(), {s.a, s.b});
  return ends;
}

void Window::set_ranges(Panel& panel) const {
  panel.x.range = {center.x() - half().x(), center.x() + half().x()};
  panel.y.range = {center.y() - half().y(), center.y() + half().y()};
}

Polyline Window::outline() const {
  const double x = half().x(), y = half().y();
  return {.points = {center + Vec2(-x, -y), center + Vec2(x, -y), center + Vec2(x, y), center + Vec2(-x, y)},
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
