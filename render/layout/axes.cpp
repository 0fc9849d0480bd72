// Draws the axes of a panel: round ticks, the grid behind the data, the frame and its labels in front of them.
#include "render/layout/axes.hpp"

#include <algorithm>
#include <cmath>

#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

constexpr Color kAxis{70, 70, 70};
constexpr Color kGridLine{228, 228, 228};

std::vector<Tick> ticks_of(const Axis& axis, double low, double high, int count) {
  if (axis.ticks.empty() && axis.log) return log_ticks(low, high, count);
  if (axis.ticks.empty()) {
    std::vector<Tick> ticks = linear_ticks(low, high, count);
    while (ticks.size() < 2 && count <= 10) ticks = linear_ticks(low, high, count *= 2);  // one alone gives no scale
    return ticks;
  }
  std::vector<Tick> ticks;
  for (const auto& [value, label] : axis.ticks)
    if (value >= low && value <= high) ticks.push_back({value, label});
  return ticks;
}

/// Marks and labels below the box; a label that would run into the one before is left out.
void add_x_ticks(const PanelLayout& p, bool labelled, double em, StrokeShape& marks, std::vector<Shape>& shapes) {
  const Font& font = Font::get();
  double last_end = -INFINITY;
  for (const Tick& t : p.x_ticks) {
    const double x = p.to_device({t.value, p.y_min}).x(), half = 0.5 * font.width_em(t.label) * em;
    marks.add_segment({x, p.box.y1}, {x, p.box.y1 + kTickLengthPt});
    if (!labelled || x - half < last_end) continue;
    add_text({x, p.box.y1 + kTickLengthPt + 2.0 + font.cap_height_em() * em}, 0.5, t.label, em, false, shapes);
    last_end = x + half + 0.25 * em;
  }
}

/// Marks and labels left of the box; returns the width of the widest label.
double add_y_ticks(const PanelLayout& p, bool labelled, double em, StrokeShape& marks, std::vector<Shape>& shapes) {
  const Font& font = Font::get();
  double widest = 0.0;
  for (const Tick& t : p.y_ticks) {
    const double y = p.to_device({p.x_min, t.value}).y();
    marks.add_segment({p.box.x0 - kTickLengthPt, y}, {p.box.x0, y});
    if (labelled)
      add_text({p.box.x0 - kTickLengthPt - 2.0, y + 0.5 * font.cap_height_em() * em}, 1.0, t.label, em, false, shapes);
    widest = std::max(widest, font.width_em(t.label) * em);
  }
  return widest;
}

}  // namespace

void choose_ticks(const Panel& panel, double em, PanelLayout& place) {
  const auto count = [](double length, double apart) { return std::clamp(static_cast<int>(length / apart), 2, 10); };
  place.x_ticks = ticks_of(panel.x, place.x_min, place.x_max, count(place.box.width(), 3.6 * em));
  place.y_ticks = ticks_of(panel.y, place.y_min, place.y_max, count(place.box.height(), 2.6 * em));
  if (!panel.equal_aspect || !panel.x.ticks.empty() || !panel.y.ticks.empty()) return;
  // A map has one step in both directions: squares of a round number of metres, two lines in each direction at least.
  for (const double apart : {3.2 * em, 2.0 * em}) {
    const double step = apart * (place.x_max - place.x_min) / place.box.width();
    const std::vector<Tick> x = ticks_apart(place.x_min, place.x_max, step);
    const std::vector<Tick> y = ticks_apart(place.y_min, place.y_max, step);
    if (x.size() < 2 || y.size() < 2) continue;
    place.x_ticks = x, place.y_ticks = y;
    return;
  }
}

double bottom_room(const Panel& panel, double em) {
  return kTickLengthPt + 1.35 * em + (panel.x.label.empty() ? 0.0 : 1.3 * em);
}

void add_grid(const Panel& panel, const PanelLayout& place, std::vector<Shape>& shapes) {
  const Rect& box = place.box;
  StrokeShape lines{.stroke = {kGridLine, 0.4, Dash::solid}, .round = false};
  for (const Tick& t : place.x_ticks)
    if (const double x = place.to_device({t.value, place.y_min}).x(); panel.x.grid)
      lines.add_segment({x, box.y0}, {x, box.y1});
  for (const Tick& t : place.y_ticks)
    if (const double y = place.to_device({place.x_min, t.value}).y(); panel.y.grid)
      lines.add_segment({box.x0, y}, {box.x1, y});
  if (!lines.points.empty()) shapes.push_back({std::move(lines)});
}

void add_frame(const Panel& panel, const PanelLayout& place, LabelledSides sides, double em,
               std::vector<Shape>& shapes) {
  const Rect& b = place.box;
  StrokeShape box{.points = {{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}},
                  .stroke = {kAxis, 0.6, Dash::solid},
                  .closed = true,
                  .round = false};
  box.end_path();
  shapes.push_back({std::move(box)});
  StrokeShape marks{.stroke = {kAxis, 0.6, Dash::solid}, .round = false};
  add_x_ticks(place, sides.bottom, em, marks, shapes);
  const double widest = add_y_ticks(place, sides.left, em, marks, shapes);
  if (!marks.points.empty()) shapes.push_back({std::move(marks)});
  if (sides.bottom)
    add_text({0.5 * (b.x0 + b.x1), b.y1 + kTickLengthPt + (1.35 + Font::get().cap_height_em()) * em + 1.0}, 0.5,
             fit_text(panel.x.label, b.width() / em), em, false, shapes);
  if (sides.left)
    add_text({b.x0 - kTickLengthPt - 2.0 - widest - 0.5 * em, 0.5 * (b.y0 + b.y1)}, 0.5,
             fit_text(panel.y.label, (b.height() + 2 * em) / em), em, true, shapes);
}

void add_text(const Vec2& at, double align, const std::string& text, double size, bool upwards,
              std::vector<Shape>& shapes) {
  if (text.empty()) return;
  const double shift = align * Font::get().width_em(text) * size;
  const Vec2 origin = upwards ? Vec2(at.x(), at.y() + shift) : Vec2(at.x() - shift, at.y());
  shapes.push_back({TextShape{origin, text, size, upwards, false, kBlack}});
}

}  // namespace scanbench::render
