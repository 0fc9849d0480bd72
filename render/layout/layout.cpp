// Boxes, axes and margins of a scene, from the widths of the texts that stand in them.
#include "render/layout/layout.hpp"

#include <algorithm>
#include <cmath>

#include "render/layout/items.hpp"
#include "render/layout/legend.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

constexpr Color kAxis{70, 70, 70};
constexpr Color kGridLine{228, 228, 228};
constexpr double kTickLength = 2.5;

struct Range {
  double low, high;
};

/// One axis' range: as asked for, else the data's with a margin. `log` ranges are positive.
Range axis_range(const Axis& axis, double low, double high, double margin) {
  if (axis.range) low = axis.range->first, high = axis.range->second;
  const bool usable = std::isfinite(low) && std::isfinite(high) && low <= high && (!axis.log || low > 0);
  if (!usable) return axis.log ? Range{0.1, 10.0} : Range{0.0, 1.0};
  if (axis.range && low < high) return {low, high};
  if (axis.log) {
    const double grow = low < high ? std::pow(high / low, margin) : 2.0;
    return {low / grow, high * grow};
  }
  const double grow = low < high ? margin * (high - low) : std::max(0.5, 1e-6 * std::abs(low));
  return {low - grow, high + grow};
}

Rect merged(const Rect& a, const Rect& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

bool has_bars(const Panel& panel) {
  return std::any_of(panel.items.begin(), panel.items.end(),
                     [](const Item& item) { return std::holds_alternative<Bars>(item); });
}

void set_ranges(const Panel& panel, const Rect& data, PanelLayout& place) {
  const double span = std::max(data.x1 - data.x0, data.y1 - data.y0);
  const auto margin = [&](double extent) {  // equal aspect: the same on all four sides
    return panel.equal_aspect && extent > 0 ? std::min(0.05 * span / extent, 10.0) : 0.05;
  };
  const Range x = axis_range(panel.x, data.x0, data.x1, margin(data.x1 - data.x0));
  Range y = axis_range(panel.y, data.y0, data.y1, margin(data.y1 - data.y0));
  if (!panel.y.range && !panel.y.log && has_bars(panel) && data.y0 == 0) y.low = 0;  // bars stand on the axis
  place.x_min = x.low, place.x_max = x.high, place.y_min = y.low, place.y_max = y.high;
  place.x_log = panel.x.log, place.y_log = panel.y.log;
}

/// Widens one range about its middle so that a unit is as long in x as in y.
void equalise(PanelLayout& place) {
  const double dx = place.x_max - place.x_min, dy = place.y_max - place.y_min;
  const double unit = std::min(place.box.width() / dx, place.box.height() / dy);
  const double grow_x = 0.5 * (place.box.width() / unit - dx), grow_y = 0.5 * (place.box.height() / unit - dy);
  place.x_min -= grow_x, place.x_max += grow_x, place.y_min -= grow_y, place.y_max += grow_y;
}

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

/// Lays out one scene; the steps share the measures below.
class Composer {
 public:
  explicit Composer(const Scene& scene)
      : scene_(scene),
        em_(scene.font_pt),
        tick_size_(0.88 * scene.font_pt),
        count_(static_cast<int>(scene.panels.size())),
        columns_(std::clamp(wanted_columns(scene), 1, std::max(1, count_))),
        rows_((count_ + columns_ - 1) / columns_) {
    out_.width = 72.0 * scene.width_in;
    out_.panels.resize(scene.panels.size());
    widest_label_.resize(scene.panels.size());
  }

  Layout compose() {
    ranges();
    // Widths of tick labels depend on the ticks, those on the boxes. Room that was needed once is kept: where labels
    // come and go with it, the last ones find it.
    for (int pass = 0; pass < 4; ++pass) {
      boxes();
      ticks();
    }
    draw();
    return std::move(out_);
  }

 private:
  static int wanted_columns(const Scene& scene) {
    return scene.columns > 0 ? scene.columns : scene.panels.size() == 4 ? 2 : 3;
  }
  const Panel& panel(int i) const { return scene_.panels[static_cast<std::size_t>(i)]; }
  PanelLayout& place(int i) { return out_.panels[static_cast<std::size_t>(i)]; }
  static double width_em(const std::string& text) { return Font::get().width_em(text); }
  bool left_axis(int i) const { return panel(i).axes && (!scene_.share_axes || i % columns_ == 0); }
  bool bottom_axis(int i) const { return panel(i).axes && (!scene_.share_axes || i + columns_ >= count_); }

  void ranges() {
    Rect all{INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (const Panel& p : scene_.panels) all = merged(all, data_bounds(p));
    for (int i = 0; i < count_; ++i) set_ranges(panel(i), scene_.share_axes ? all : data_bounds(panel(i)), place(i));
    if (scene_.share_axes && count_ > 0) {
      PanelLayout shared = out_.panels[0];
      for (const PanelLayout& p : out_.panels) {
        shared.x_min = std::min(shared.x_min, p.x_min), shared.x_max = std::max(shared.x_max, p.x_max);
        shared.y_min = std::min(shared.y_min, p.y_min), shared.y_max = std::max(shared.y_max, p.y_max);
      }
      std::fill(out_.panels.begin(), out_.panels.end(), shared);
    }
    natural_ = out_.panels;
  }

  /// Room left of a box for tick labels and the axis label.
  double left_room(int i) {
    if (!left_axis(i)) return 0.0;
    double& widest = widest_label_[static_cast<std::size_t>(i)];
    for (const Tick& t : place(i).y_ticks) widest = std::max(widest, width_em(t.label) * tick_size_);
    return kTickLength + 2.0 + widest + (panel(i).y.label.empty() ? 0.0 : 1.35 * em_);
  }
  double bottom_room(int i) const {
    return bottom_axis(i) ? kTickLength + 1.25 * em_ + (panel(i).x.label.empty() ? 0.0 : 1.3 * em_) : 0.0;
  }
  /// Half of the last tick label may stand out at the right.
  double right_room(int i) {
    double room = 0.3 * em_;
    if (!panel(i).axes) return room;
    for (const Tick& t : place(i).x_ticks)
      room = std::max(room, place(i).to_device({t.value, place(i).y_min}).x() + 0.5 * width_em(t.label) * tick_size_ -
                                place(i).box.x1);
    return room;
  }

  void boxes() {
    const double pad = 0.4 * em_;
    const double title = scene_.title.empty() ? 0.0 : 1.9 * em_;
    const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
    std::vector<double> left(columns, 0.0), above(rows, 0.0), below(rows, 0.0);
    double right = 0.0, aspect = 0.0;
    for (int i = 0; i < count_; ++i) {
      const auto c = static_cast<std::size_t>(i % columns_), r = static_cast<std::size_t>(i / columns_);
      left[c] = std::max(left[c], left_room(i));
      above[r] = std::max(above[r], panel(i).title.empty() ? 0.3 * em_ : 1.45 * em_);
      below[r] = std::max(below[r], bottom_room(i));
      right = std::max(right, right_room(i));
      const PanelLayout& p = natural_[static_cast<std::size_t>(i)];
      aspect = std::max(aspect, panel(i).equal_aspect ? std::clamp((p.y_max - p.y_min) / (p.x_max - p.x_min), 0.3, 2.5)
                                                      : scene_.box_aspect);
    }
    const double gap_x = 1.4 * em_, gap_y = 0.5 * em_;
    double fixed_x = 2 * pad + right + gap_x * (columns_ - 1), fixed_y = 2 * pad + title + gap_y * (rows_ - 1);
    for (const double l : left) fixed_x += l;
    for (std::size_t r = 0; r < rows; ++r) fixed_y += above[r] + below[r];
    const double legend = add_legend(scene_, out_.scale_bar_m, out_.scale_bar_pt, out_.width, 0.0, nullptr);
    fixed_y += legend > 0 ? legend + 0.4 * em_ : 0.0;

    double box_w = std::max(1.0, (out_.width - fixed_x) / columns_), box_h = aspect * box_w;
    const bool sized = scene_.height_in > 0;
    const double tallest =
        std::max(1.0, (72.0 * (sized ? scene_.height_in : scene_.max_height_in) - fixed_y) / std::max(1, rows_));
    if (sized || box_h > tallest) box_h = tallest;
    const bool all_equal =
        std::all_of(scene_.panels.begin(), scene_.panels.end(), [](const Panel& p) { return p.equal_aspect; });
    if (all_equal && aspect > 0) box_w = std::min(box_w, std::max(box_h / aspect, 0.5 * box_w));

    if (sized)
      out_.height = 72.0 * scene_.height_in;
    else
      out_.height = count_ > 0 ? fixed_y + rows_ * box_h : std::max(fixed_y, 0.5 * out_.width);
    const double slack = 0.5 * (out_.width - fixed_x - columns_ * box_w);
    double y = pad + title;
    for (int r = 0; r < rows_; ++r) {
      y += above[static_cast<std::size_t>(r)];
      double x = pad + slack;
      for (int c = 0; c < columns_; ++c) {
        x += left[static_cast<std::size_t>(c)];
        if (const int i = r * columns_ + c; i < count_) {
          place(i) = natural_[static_cast<std::size_t>(i)];
          place(i).box = {x, y, x + box_w, y + box_h};
          if (panel(i).equal_aspect) equalise(place(i));
        }
        x += box_w + gap_x;
      }
      y += box_h + below[static_cast<std::size_t>(r)] + gap_y;
    }
    legend_top_ = count_ > 0 ? y - gap_y + 0.4 * em_ : pad + title;
    out_.scale_bar_m = out_.scale_bar_pt = 0.0;
    if (scene_.scale_bar && count_ > 0) {
      const double pt_per_m = place(0).box.width() / (place(0).x_max - place(0).x_min);
      out_.scale_bar_m = round_below(0.16 * place(0).box.width() / pt_per_m);
      out_.scale_bar_pt = out_.scale_bar_m * pt_per_m;
    }
  }

  void ticks() {
    for (int i = 0; i < count_; ++i) {
      PanelLayout& p = place(i);
      const auto count = [](double length, double apart) {
        return std::clamp(static_cast<int>(length / apart), 2, 10);
      };
      p.x_ticks = ticks_of(panel(i).x, p.x_min, p.x_max, count(p.box.width(), 3.6 * em_));
      p.y_ticks = ticks_of(panel(i).y, p.y_min, p.y_max, count(p.box.height(), 2.6 * em_));
      if (!panel(i).equal_aspect || !panel(i).x.ticks.empty() || !panel(i).y.ticks.empty()) continue;
      // A map has one step in both directions: squares of a round number of metres, two lines each way at least.
      for (const double apart : {3.2 * em_, 2.0 * em_}) {
        const double step = apart * (p.x_max - p.x_min) / p.box.width();
        const std::vector<Tick> x = ticks_apart(p.x_min, p.x_max, step), y = ticks_apart(p.y_min, p.y_max, step);
        if (x.size() < 2 || y.size() < 2) continue;
        p.x_ticks = x, p.y_ticks = y;
        break;
      }
    }
  }

  void text(double x, double y, double align, const std::string& s, double size, Color color, bool upwards = false) {
    if (s.empty()) return;
    const double shift = align * width_em(s) * size;
    out_.shapes.push_back(
        {TextShape{upwards ? Vec2(x, y + shift) : Vec2(x - shift, y), s, size, upwards, false, color}});
  }

  void draw() {
    const double cap = Font::get().cap_height_em();
    if (!scene_.title.empty()) {
      const double size = 1.12 * em_;
      text(0.5 * out_.width, 0.4 * em_ + 1.15 * em_, 0.5, fit_text(scene_.title, (out_.width - em_) / size), size,
           kBlack);
    }
    for (int i = 0; i < count_; ++i) {
      const PanelLayout p = place(i);
      if (panel(i).axes) grid(panel(i), p);
      add_items(panel(i), i, p, em_, out_.shapes);
      if (panel(i).axes) frame(i, p, cap);
      text(0.5 * (p.box.x0 + p.box.x1), p.box.y0 - 0.4 * em_, 0.5, fit_text(panel(i).title, p.box.width() / em_), em_,
           kBlack);
    }
    add_legend(scene_, out_.scale_bar_m, out_.scale_bar_pt, out_.width, legend_top_, &out_.shapes);
  }

  void grid(const Panel& panel, const PanelLayout& p) {
    StrokeShape lines{.stroke = {kGridLine, 0.4, Dash::solid}, .round = false};
    for (const Tick& t : p.x_ticks)
      if (const double x = p.to_device({t.value, p.y_min}).x(); panel.x.grid)
        lines.add_segment({x, p.box.y0}, {x, p.box.y1});
    for (const Tick& t : p.y_ticks)
      if (const double y = p.to_device({p.x_min, t.value}).y(); panel.y.grid)
        lines.add_segment({p.box.x0, y}, {p.box.x1, y});
    if (!lines.points.empty()) out_.shapes.push_back({std::move(lines)});
  }

  void frame(int i, const PanelLayout& p, double cap) {
    const Rect& b = p.box;
    StrokeShape box{.points = {{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}},
                    .stroke = {kAxis, 0.6, Dash::solid},
                    .closed = true,
                    .round = false};
    box.end_path();
    out_.shapes.push_back({std::move(box)});
    StrokeShape marks{.stroke = {kAxis, 0.6, Dash::solid}, .round = false};
    double widest = 0.0, last_end = -INFINITY;
    for (const Tick& t : p.x_ticks) {
      const double x = p.to_device({t.value, p.y_min}).x();
      marks.add_segment({x, b.y1}, {x, b.y1 + kTickLength});
      const double half = 0.5 * width_em(t.label) * tick_size_;
      if (!bottom_axis(i) || x - half < last_end) continue;  // a label that would run into the one before is left out
      text(x, b.y1 + kTickLength + 2.0 + cap * tick_size_, 0.5, t.label, tick_size_, kBlack);
      last_end = x + half + 0.25 * em_;
    }
    for (const Tick& t : p.y_ticks) {
      const double y = p.to_device({p.x_min, t.value}).y();
      marks.add_segment({b.x0 - kTickLength, y}, {b.x0, y});
      if (left_axis(i)) text(b.x0 - kTickLength - 2.0, y + 0.5 * cap * tick_size_, 1.0, t.label, tick_size_, kBlack);
      widest = std::max(widest, width_em(t.label) * tick_size_);
    }
    if (!marks.points.empty()) out_.shapes.push_back({std::move(marks)});
    if (bottom_axis(i))
      text(0.5 * (b.x0 + b.x1), b.y1 + kTickLength + 1.25 * em_ + cap * em_ + 1.0, 0.5,
           fit_text(panel(i).x.label, b.width() / em_), em_, kBlack);
    if (left_axis(i))
      text(b.x0 - kTickLength - 2.0 - widest - 0.5 * em_, 0.5 * (b.y0 + b.y1), 0.5,
           fit_text(panel(i).y.label, (b.height() + 2 * em_) / em_), em_, kBlack, true);
  }

  const Scene& scene_;
  double em_, tick_size_;
  int count_, columns_, rows_;
  std::vector<double> widest_label_;  // of each panel's y axis so far [pt]
  std::vector<PanelLayout> natural_;  // ranges before they grow to fill their boxes
  double legend_top_ = 0.0;
  Layout out_;
};

}  // namespace

Layout layout(const Scene& scene) {
  return Composer(scene).compose();
}

}  // namespace scanbench::render
