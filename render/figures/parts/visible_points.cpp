// Measures points against the width of the lines on paper.
#include "render/figures/parts/visible_points.hpp"

#include <algorithm>
#include <cstddef>

#include "render/layout/layout.hpp"

namespace scanbench::render {
namespace {

constexpr std::size_t kMostTried = 1500;
constexpr double kVisibleShare = 0.01;
constexpr double kNarrower = 2.0;  // a figure for a page, put in a column

/// Metres of a point of paper in the first panel.
double metres_per_pt(const Scene& scene) {
  Scene frames = scene;
  for (Panel& panel : frames.panels) panel.items.clear();
  const Layout placed = layout(frames);
  const PanelLayout& first = placed.panels.front();
  return (first.x_max - first.x_min) / first.box.width();
}

}  // namespace

bool seen_beside(std::span<const Vec2> points, std::span<const Segment> segments, double stroke_pt,
                 const Scene& scene) {
  if (points.empty() || scene.panels.empty()) return false;
  const double hidden_m = 0.5 * stroke_pt * kNarrower * metres_per_pt(scene);
  const std::size_t stride = points.size() / kMostTried + 1;
  std::size_t tried = 0, visible = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++tried)
    if (std::ranges::none_of(segments, [&](const Segment& s) { return distance(points[i], s) <= hidden_m; })) ++visible;
  return static_cast<double>(visible) >= kVisibleShare * static_cast<double>(tried);
}

}  // namespace scanbench::render
