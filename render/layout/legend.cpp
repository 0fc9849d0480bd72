// Places legend entries in centred rows.
#include "render/layout/legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "render/layout/markers.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

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
    box.end_contour();
    shapes.push_back({std::move(box)});
  }
  if (entry.arrow) {
    add_arrow({x + 0.2 * em, y}, {w - 0.3 * em, 0}, entry.stroke.value_or(Stroke{}), -1, shapes);
  } else if (entry.stroke) {
    StrokeShape line{.stroke = *entry.stroke};
    line.add_segment({x, y}, {x + w, y});
    shapes.push_back({std::move(line)});
  }
  if (entry.marker != Marker::none)
    add_markers({{x + 0.5 * w, y}}, entry.marker, entry.marker_size_pt, entry.marker_color, entry.marker_filled, -1,
                shapes);
}

constexpr int kTextLines = 4;  // of an entry, at most
constexpr double kRowEm = 1.5;
constexpr double kLineEm = 1.2;

struct Piece {
  const LegendEntry* entry;  // nullptr: the scale bar
  std::vector<std::string> lines;
  double swatch, width;
};

std::vector<Piece> pieces_of(const Scene& scene, const ScaleBar& scale_bar, double room) {
  const Font& font = Font::get();
  const double em = scene.font_pt;
  std::vector<Piece> pieces;
  const auto add = [&](const LegendEntry* entry, std::vector<std::string> lines, double swatch) {
    double widest = 0.0;
    for (const std::string& line : lines) widest = std::max(widest, font.width_em(line) * em);
    pieces.push_back({entry, std::move(lines), swatch, swatch + 0.5 * em + widest});
  };
  for (const LegendEntry& entry : scene.legend) {
    const double swatch = swatch_width(entry, em);
    add(&entry, wrap_text(entry.text, (room - swatch - 0.5 * em) / em, kTextLines), swatch);
  }
  if (scale_bar.length_pt > 0) add(nullptr, {fmt::format("{:g} m", scale_bar.metres)}, scale_bar.length_pt);
  return pieces;
}

void add_scale_bar(double x, double y, double length, std::vector<Shape>& shapes) {
  StrokeShape bar{.stroke = {kBlack, 0.8, Dash::solid}, .round = false};
  bar.add_segment({x, y - 2}, {x, y + 2});
  bar.add_segment({x, y}, {x + length, y});
  bar.add_segment({x + length, y - 2}, {x + length, y + 2});
  shapes.push_back({std::move(bar)});
}

}  // namespace

double widest_entry(const Scene& scene, const ScaleBar& scale_bar) {
  double widest = 0.0;
  for (const Piece& piece : pieces_of(scene, scale_bar, INFINITY)) widest = std::max(widest, piece.width);
  return widest + 2 * scene.font_pt;
}

double add_legend(const Scene& scene, const ScaleBar& scale_bar, const LegendRoom& room, std::vector<Shape>* shapes) {
  const double em = scene.font_pt, gap = 1.5 * em;
  const double cap = Font::get().cap_height_em();
  const std::vector<Piece> pieces = pieces_of(scene, scale_bar, room.width - 2 * em);
  double y = room.top;
  for (std::size_t first = 0, last; first < pieces.size(); first = last) {
    double used = pieces[first].width;
    for (last = first + 1; last < pieces.size() && used + gap + pieces[last].width <= room.width - 2 * em; ++last)
      used += gap + pieces[last].width;
    double x = room.left + 0.5 * (room.width - used);
    std::size_t most_lines = 1;
    for (std::size_t i = first; i < last; ++i) most_lines = std::max(most_lines, pieces[i].lines.size());
    const double row_height = (kRowEm + kLineEm * static_cast<double>(most_lines - 1)) * em;
    const double middle = y + 0.5 * row_height;
    for (std::size_t i = first; i < last && shapes != nullptr; ++i) {
      const Piece& piece = pieces[i];
      if (piece.entry != nullptr)
        add_swatch(*piece.entry, x, middle, em, *shapes);
      else
        add_scale_bar(x, middle, piece.swatch, *shapes);
      const double above = 0.5 * kLineEm * static_cast<double>(piece.lines.size() - 1);  // of the middle, in em
      for (std::size_t k = 0; k < piece.lines.size(); ++k) {
        const double down = 0.5 * cap + kLineEm * static_cast<double>(k) - above;
        const Vec2 origin(x + piece.swatch + 0.5 * em, middle + down * em);
        shapes->push_back({TextShape{origin, piece.lines[k], em, false, false, kBlack}});
      }
      x += piece.width + gap;
    }
    y += row_height;
  }
  return y;
}

}  // namespace scanbench::render
