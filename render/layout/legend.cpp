// Rows of swatches with their texts.
#include "render/layout/legend.hpp"

#include <string>

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

}  // namespace

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
        StrokeShape bar{.stroke = {kBlack, 0.8, Dash::solid}, .round = false};
        bar.add_segment({x, middle - 2}, {x, middle + 2});
        bar.add_segment({x, middle}, {x + scale_bar_pt, middle});
        bar.add_segment({x + scale_bar_pt, middle - 2}, {x + scale_bar_pt, middle + 2});
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
