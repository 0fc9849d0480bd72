// Markers, arrows and the legend, in points on paper.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "render/layout/layout.hpp"
#include "render/paper/font.hpp"

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

double swatch_width(const LegendEntry& entry, double em) {
  if (entry.arrow) return 1.8 * em;
  if (entry.stroke) return 2.4 * em;
  return entry.fill ? 1.2 * em : 0.9 * em;
}

void add_swatch(const LegendEntry& entry, double x, double y, double em, std::vector<Shape>& shapes) {
  const double w = swatch_width(entry, em);
  if (entry.fill) {
    FillShape box{.points = {{x, y - 0.35 * em}, {x + w, y - 0.35 * em}, {x + w, y + 0.35 * em}, {x, y + 0.35 * em}},
                  .color = *entry.fill};
    box.starts.push_back(4);
    shapes.push_back({std::move(box)});
  }
  if (entry.arrow) {
    add_arrow({x + 0.2 * em, y}, {w - 0.3 * em, 0}, entry.stroke.value_or(Stroke{}), -1, shapes);
  } else if (entry.stroke) {
    StrokeShape line{.points = {{x, y}, {x + w, y}}, .stroke = *entry.stroke};
    line.end_path();
    shapes.push_back({std::move(line)});
  }
  if (entry.marker != Marker::none)
    add_markers({{x + 0.5 * w, y}}, entry.marker, entry.marker_size_pt, entry.marker_color, entry.marker_filled, -1,
                shapes);
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
      for (const Vec2& v : {u, perpendicular(u)}) {
        shape.points.emplace_back(c - v);
        shape.points.emplace_back(c + v);
        shape.end_path();
      }
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
    fill.starts.push_back(fill.points.size());
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
  StrokeShape shaft{.points = {from, neck}, .stroke = stroke};
  shaft.end_path();
  FillShape point{.points = {tip, neck + side, neck - side}, .color = stroke.color};
  point.starts.push_back(3);
  shapes.push_back({std::move(shaft), clip});
  shapes.push_back({std::move(point), clip});
  shapes.push_back({DotsShape{{from}, 2.4 + 1.2 * stroke.width_pt, stroke.color}, clip});
}

double add_legend(const Scene& scene, double scale_bar_m, double scale_bar_pt, double width, double top,
                  std::vector<Shape>* shapes) {
  const Font& font = Font::get();
  const double em = scene.font_pt, size = 0.95 * em, row_height = 1.5 * em, gap = 1.5 * em;
  const double room = width - 2 * em;
  struct Piece {
    const LegendEntry* entry;  // nullptr: the scale bar
    std::string text;
    double swatch, width;
  };
  std::vector<Piece> pieces;
  for (const LegendEntry& entry : scene.legend) {
    const double swatch = swatch_width(entry, em);
    const std::string text = fit_text(entry.text, (room - swatch - 0.5 * em) / size);
    pieces.push_back({&entry, text, swatch, swatch + 0.5 * em + font.width_em(text) * size});
  }
  if (scale_bar_pt > 0) {
    const std::string text = fmt::format("{:g} m", scale_bar_m);
    pieces.push_back({nullptr, text, scale_bar_pt, scale_bar_pt + 0.5 * em + font.width_em(text) * size});
  }
  double y = top;
  for (std::size_t first = 0, last; first < pieces.size(); first = last) {
    double used = pieces[first].width;
    for (last = first + 1; last < pieces.size() && used + gap + pieces[last].width <= room; ++last)
      used += gap + pieces[last].width;
    double x = 0.5 * (width - used);
    const double middle = y + 0.5 * row_height;
    for (std::size_t i = first; i < last && shapes != nullptr; ++i) {
      const Piece& piece = pieces[i];
      if (piece.entry != nullptr) {
        add_swatch(*piece.entry, x, middle, em, *shapes);
      } else {
        StrokeShape bar{
            .points = {{x, middle - 2}, {x, middle + 2}}, .stroke = {kBlack, 0.8, Dash::solid}, .round = false};
        bar.end_path();
        bar.points.insert(bar.points.end(), {Vec2(x, middle), Vec2(x + scale_bar_pt, middle)});
        bar.end_path();
        bar.points.insert(bar.points.end(), {Vec2(x + scale_bar_pt, middle - 2), Vec2(x + scale_bar_pt, middle + 2)});
        bar.end_path();
        shapes->push_back({std::move(bar)});
      }
      const Vec2 origin(x + piece.swatch + 0.5 * em, middle + 0.5 * font.cap_height_em() * size);
      shapes->push_back({TextShape{origin, piece.text, size, false, false, kBlack}});
      x += piece.width + gap;
    }
    y += row_height;
  }
  return y;
}

}  // namespace scanbench::render
