// Makes the outlines of markers and arrows.
#include "render/layout/markers.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {
namespace {

/// Corners of a marker of unit radius, y down; sizes chosen so that all look equally large.
std::vector<Vec2> outline(Marker marker) {
  switch (marker) {
    case Marker::square:
      return {{-0.86, -0.86}, {0.86, -0.86}, {0.86, 0.86}, {-0.86, 0.86}};
    case Marker::diamond:
      return {{0, -1.2}, {1.2, 0}, {0, 1.2}, {-1.2, 0}};
    case Marker::triangle:
      return {{0, -1.15}, {1.1, 0.85}, {-1.1, 0.85}};
    case Marker::triangle_down:
      return {{0, 1.15}, {1.1, -0.85}, {-1.1, -0.85}};
    default:
      return {};
  }
}

}  // namespace

void add_markers(const std::vector<Vec2>& centers, Marker marker, double size_pt, Color color, bool filled, int clip,
                 std::vector<Shape>& shapes) {
  if (centers.empty() || marker == Marker::none) return;
  const double rim = std::max(0.6, 0.16 * size_pt), r = 0.5 * size_pt;
  if (marker == Marker::dot || marker == Marker::circle) {
    shapes.push_back({DotsShape{centers, size_pt, color}, clip});
    if (!filled && size_pt > 2 * rim) shapes.push_back({DotsShape{centers, size_pt - 2 * rim, kWhite}, clip});
    return;
  }
  if (marker == Marker::plus || marker == Marker::cross) {
    StrokeShape shape{.stroke = {color, rim * 1.4, Dash::solid}, .round = false};
    const Vec2 u = marker == Marker::plus ? Vec2(1.1 * r, 0) : Vec2(0.8 * r, 0.8 * r);
    for (const Vec2& c : centers)
      for (const Vec2& v : {u, perpendicular(u)}) shape.add_segment(c - v, c + v);
    shapes.push_back({std::move(shape), clip});
    return;
  }
  FillShape fill{.color = filled ? color : kWhite};
  StrokeShape edge{.stroke = {color, rim, Dash::solid}, .closed = true};
  const double scale = filled ? r : r - 0.5 * rim;
  for (const Vec2& c : centers) {
    for (const Vec2& corner : outline(marker)) {
      fill.points.emplace_back(c + scale * corner);
      edge.points.emplace_back(c + scale * corner);
    }
    fill.end_contour();
    edge.end_path();
  }
  shapes.push_back({std::move(fill), clip});
  if (!filled) shapes.push_back({std::move(edge), clip});
}

void add_arrow(const Vec2& from, const Vec2& along, const Stroke& stroke, int clip, std::vector<Shape>& shapes) {
  const double length = along.norm();
  if (!(length > 0)) return;
  const Vec2 u = along / length;
  const double head = std::min(0.6 * length, 3.0 + 2.0 * stroke.width_pt);
  const Vec2 tip = from + along, neck = tip - head * u, side = 0.42 * head * perpendicular(u);
  StrokeShape shaft{.stroke = stroke};
  shaft.add_segment(from, neck);
  FillShape point{.points = {tip, neck + side, neck - side}, .color = stroke.color};
  point.end_contour();
  shapes.push_back({std::move(shaft), clip});
  shapes.push_back({std::move(point), clip});
  shapes.push_back({DotsShape{{from}, 2.4 + 1.2 * stroke.width_pt, stroke.color}, clip});
}

}  // namespace scanbench::render
