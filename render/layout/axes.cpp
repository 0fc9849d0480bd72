// Draws the axes of a panel: round ticks, the grid behind the data, the frame and its labels in front of them.
#include "render/layout/axes.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "render/layout/shown_unit.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

constexpr Color kAxis{70, 70, 70};
constexpr Color kGridLine{228, 228, 228};
constexpr int kLabelLines = 5;          // at most
constexpr double kLabelHeight = 1.2;    // of a further line
constexpr double kLabelOverhang = 2.0;  // an upright label may be longer than the box is high

std::vector<Tick> round_ticks_of(const Axis& axis, double low, double high, int count) {
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

/// The ticks at round numbers of the unit that suits the range, and that unit.
std::pair<std::vector<Tick>, std::string> ticks_of(const Axis& axis, double low, double high, int count) {
  if (!axis.ticks.empty()) return {round_ticks_of(axis, low, high, count), axis.unit};
  const ShownUnit shown = shown_unit(axis.unit, low, high, axis.log);
  std::vector<Tick> ticks = round_ticks_of(axis, shown.per_data * low, shown.per_data * high, count);
  if (shown.per_data != 1.0)
    for (Tick& tick : ticks) tick.value /= shown.per_data;
  return {std::move(ticks), shown.text};
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
  std::string x_unit, y_unit;
  std::tie(place.x_ticks, x_unit) = ticks_of(panel.x, place.x_min, place.x_max, count(place.box.width(), 3.6 * em));
  std::tie(place.y_ticks, y_unit) = ticks_of(panel.y, place.y_min, place.y_max, count(place.box.height(), 2.6 * em));
  place.x_label = with_unit(panel.x.label, x_unit);
  place.y_label = with_unit(panel.y.label, y_unit);
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

std::vector<std::string> x_label_lines(const PanelLayout& place, double em) {
  return wrap_text(place.x_label, place.box.width() / em, kLabelLines);
}

std::vector<std::string> y_label_lines(const PanelLayout& place, double em) {
  return wrap_text(place.y_label, place.box.height() / em + kLabelOverhang, kLabelLines);
}

double bottom_room(std::size_t lines, double em) {
  const double label = lines == 0 ? 0.0 : 1.3 + kLabelHeight * static_cast<double>(lines - 1);
  return kTickLengthPt + (1.35 + label) * em;
}

double left_label_room(std::size_t lines, double em) {
  return lines == 0 ? 0.0 : (1.35 + kLabelHeight * static_cast<double>(lines - 1)) * em;
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

void add_frame(const PanelLayout& place, LabelledSides sides, double em, std::vector<Shape>& shapes) {
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
  if (sides.bottom) {
    double y = b.y1 + kTickLengthPt + (1.35 + Font::get().cap_height_em()) * em + 1.0;
    for (const std::string& line : x_label_lines(place, em)) {
      add_text({0.5 * (b.x0 + b.x1), y}, 0.5, line, em, false, shapes);
      y += kLabelHeight * em;
    }
  }
  if (sides.left) {
    const std::vector<std::string> lines = y_label_lines(place, em);
    const double last = b.x0 - kTickLengthPt - 2.0 - widest - 0.5 * em;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double x = last - kLabelHeight * em * static_cast<double>(lines.size() - 1 - k);
      add_text({x, 0.5 * (b.y0 + b.y1)}, 0.5, lines[k], em, true, shapes);
    }
  }
}

void add_text(const Vec2& at, double align, const std::string& text, double size, bool upwards,
              std::vector<Shape>& shapes) {
  if (text.empty()) return;
  const double shift = align * Font::get().width_em(text) * size;
  const Vec2 origin = upwards ? Vec2(at.x(), at.y() + shift) : Vec2(at.x() - shift, at.y());
  shapes.push_back({TextShape{origin, text, size, upwards, false, kBlack}});
}

}  // namespace scanbench::render
