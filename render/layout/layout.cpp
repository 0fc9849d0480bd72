// Computes the boxes and margins of a scene from the widths of the texts around them.
#include "render/layout/layout.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "render/layout/axes.hpp"
#include "render/layout/dark.hpp"
#include "render/layout/items.hpp"
#include "render/layout/legend.hpp"
#include "render/layout/ranges.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

constexpr int kTitleLines = 3;       // at most
constexpr double kTitleSize = 1.12;  // of the scene, relative to the font
constexpr double kLineHeight = 1.2;
constexpr double kLeastPanelEm = 8.0;  // least height of a panel without a stated height

Rect merged(const Rect& a, const Rect& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Room around the boxes of a grid of panels.
struct Margins {
  std::vector<double> gap;           ///< before each column but the first
  std::vector<double> left;          ///< per column
  std::vector<double> above, below;  ///< per row
  double right = 0.0;
};

/// Lays out one scene; the steps share the measures below.
class Composer {
 public:
  explicit Composer(const Scene& scene)
      : scene_(scene),
        em_(scene.font_pt),
        count_(static_cast<int>(scene.panels.size())),
        columns_(std::clamp(wanted_columns(scene), 1, std::max(1, count_))),
        rows_((count_ + columns_ - 1) / columns_) {
    out_.width = 72.0 * scene.width_in;
    out_.panels.resize(scene.panels.size());
    widest_label_.resize(scene.panels.size());
    title_lines_.resize(scene.panels.size(), 1);
    for (const Panel& panel : scene.panels) {
      x_lines_.push_back(panel.x.label.empty() ? 0 : 1);
      y_lines_.push_back(panel.y.label.empty() ? 0 : 1);
    }
    title_ = wrap_text(scene.title, (out_.width - em_) / (kTitleSize * em_), kTitleLines);
  }

  Layout compose() {
    ranges();
    // Widths of tick labels depend on the ticks, those on the boxes. Room that was needed once is kept, so that labels
    // that come and go with it still fit at the end.
    for (int pass = 0; pass < 4; ++pass) {
      boxes();
      for (int i = 0; i < count_; ++i) choose_ticks(panel(i), em_, place(i));
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
    for (const Tick& t : place(i).y_ticks) widest = std::max(widest, Font::get().width_em(t.label) * em_);
    return kTickLengthPt + 2.0 + widest + left_label_room(y_lines(i), em_);
  }
  double below_room(int i) { return bottom_room(x_lines(i), em_); }

  /// Lines of the labels in the box of the last pass, or more if it was narrower before.
  std::size_t x_lines(int i) {
    std::size_t& lines = x_lines_[static_cast<std::size_t>(i)];
    return lines = std::max(lines, x_label_lines(place(i), em_).size());
  }
  std::size_t y_lines(int i) {
    std::size_t& lines = y_lines_[static_cast<std::size_t>(i)];
    return lines = std::max(lines, y_label_lines(place(i), em_).size());
  }

  /// How far tick labels reach beyond the left and the right side of the box.
  std::pair<double, double> overhang(int i) {
    std::pair<double, double> beyond{0.0, 0.0};
    if (!bottom_axis(i)) return beyond;
    for (const Tick& t : place(i).x_ticks) {
      const double x = place(i).to_device({t.value, place(i).y_min}).x();
      const double half = 0.5 * Font::get().width_em(t.label) * em_;
      beyond = {std::max(beyond.first, place(i).box.x0 - x + half),
                std::max(beyond.second, x + half - place(i).box.x1)};
    }
    return beyond;
  }

  /// Between columns: tick labels of neighbouring panels do not touch.
  std::vector<double> gaps(const std::vector<double>& left) {
    std::vector<double> gap(left.size(), 1.4 * em_);
    for (int i = 1; i < count_; ++i)
      if (const auto c = static_cast<std::size_t>(i % columns_); c > 0)
        gap[c] = std::max(gap[c], overhang(i - 1).second + overhang(i).first + 0.6 * em_ - left[c]);
    return gap;
  }

  /// Room for the title, in as many lines as the box of the last pass needs.
  double above_room(int i) {
    const auto k = static_cast<std::size_t>(i);
    if (panel(i).title.empty()) return 0.3 * em_;
    if (const double width = place(i).box.width(); width > 0)
      title_lines_[k] = std::max(title_lines_[k], wrap_text(panel(i).title, width / em_, kTitleLines).size());
    return (0.25 + kLineHeight * static_cast<double>(title_lines_[k])) * em_;
  }

  Margins margins() {
    const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
    Margins m{{}, std::vector(columns, 0.0), std::vector(rows, 0.0), std::vector(rows, 0.0), 0.3 * em_};
    for (int i = 0; i < count_; ++i) {
      const auto c = static_cast<std::size_t>(i % columns_), r = static_cast<std::size_t>(i / columns_);
      m.left[c] = std::max(m.left[c], left_room(i));
      m.above[r] = std::max(m.above[r], above_room(i));
      m.right = std::max(m.right, overhang(i).second);
      // Labels of a panel above a free cell hang into that cell, so that all rows keep their spacing.
      const bool hangs = scene_.share_axes && i / columns_ + 1 < rows_;
      if (bottom_axis(i) && !hangs) m.below[r] = std::max(m.below[r], below_room(i));
    }
    m.gap = gaps(m.left);
    return m;
  }

  /// Height over width of the tallest panel, for boxes of this width.
  double tallest_aspect(double box_w) const {
    double aspect = 0.0;
    for (int i = 0; i < count_; ++i)
      aspect = std::max(aspect, panel(i).equal_aspect ? map_aspect(i, box_w) : scene_.box_aspect);
    return aspect;
  }

  double map_aspect(int i, double box_w) const {
    const PanelLayout& p = natural_[static_cast<std::size_t>(i)];
    const LetterRoom& room = panel(i).room;
    const double data = std::clamp((p.y_max - p.y_min) / (p.x_max - p.x_min), 0.3, 2.5);
    const double data_w = std::max(box_w - (room.left + room.right) * em_, kLeastDataShare * box_w);
    return (data * data_w + (room.below + room.above) * em_) / box_w;
  }

  double title_room() const { return title_.empty() ? 0.0 : (0.55 + 1.35 * static_cast<double>(title_.size())) * em_; }

  void boxes() {
    const Margins m = margins();
    set_boxes(m, 0.0);
    if (!legend_fits_free_cells(m)) {
      const double legend = add_legend(scene_, bar_, {0.0, 0.0, out_.width}, nullptr);
      set_boxes(m, legend > 0 ? legend + 0.4 * em_ : 0.0);
    }
    set_scale_bar();
  }

  /// Places the boxes with `legend` points left free below them.
  void set_boxes(const Margins& m, double legend) {
    const double pad = 0.4 * em_, gap_y = 0.5 * em_;
    double fixed_x = 2 * pad + m.right;
    for (std::size_t c = 1; c < m.gap.size(); ++c) fixed_x += m.gap[c];
    double fixed_y = 2 * pad + title_room() + gap_y * (rows_ - 1) + legend;
    for (const double l : m.left) fixed_x += l;
    for (std::size_t r = 0; r < m.above.size(); ++r) fixed_y += m.above[r] + m.below[r];

    double box_w = std::max(1.0, (out_.width - fixed_x) / columns_);
    const double aspect = tallest_aspect(box_w);
    double box_h = aspect * box_w;
    const bool sized = scene_.height_in > 0;
    // A picture may become higher than its limit rather than lose its panels between their labels.
    const double least = sized ? 1.0 : kLeastPanelEm * scene_.font_pt;
    const double tallest =
        std::max(least, (72.0 * (sized ? scene_.height_in : scene_.max_height_in) - fixed_y) / std::max(1, rows_));
    if (sized || box_h > tallest) box_h = tallest;
    const bool all_equal =
        std::all_of(scene_.panels.begin(), scene_.panels.end(), [](const Panel& p) { return p.equal_aspect; });
    if (all_equal && aspect > 0) box_w = std::min(box_w, std::max(box_h / aspect, 0.5 * box_w));

    if (sized)
      out_.height = 72.0 * scene_.height_in;
    else
      out_.height = count_ > 0 ? fixed_y + rows_ * box_h : std::max(fixed_y, 0.5 * out_.width);
    const double slack = 0.5 * (out_.width - fixed_x - columns_ * box_w);
    double y = pad + title_room();
    for (int r = 0; r < rows_; ++r) {
      y += m.above[static_cast<std::size_t>(r)];
      double x = pad + slack;
      for (int c = 0; c < columns_; ++c) {
        x += m.left[static_cast<std::size_t>(c)] + (c > 0 ? m.gap[static_cast<std::size_t>(c)] : 0.0);
        if (const int i = r * columns_ + c; i < count_) {
          place(i) = natural_[static_cast<std::size_t>(i)];
          place(i).box = {x, y, x + box_w, y + box_h};
          if (panel(i).equal_aspect) equalise(panel(i).room, em_, place(i));
        }
        x += box_w;
      }
      y += box_h + m.below[static_cast<std::size_t>(r)] + gap_y;
    }
    legend_room_ = {0.0, count_ > 0 ? y - gap_y + 0.4 * em_ : pad + title_room(), out_.width};
  }

  /// Centres the legend in the free cells of the last row, if there are any and all of its texts fit.
  bool legend_fits_free_cells(const Margins& m) {
    const int filled = count_ % columns_;
    if (rows_ < 2 || filled == 0 || scene_.legend.empty()) return false;
    const int over = (rows_ - 2) * columns_ + filled;  // the panel over the first free cell
    const double hanging = scene_.share_axes && panel(over).axes ? below_room(over) : m.below[0];
    const double top = place(over).box.y1 + hanging + 0.6 * em_;
    const double bottom = place(count_ - 1).box.y1 + m.below.back();
    const LegendRoom room{place(over).box.x0, top, place((rows_ - 1) * columns_ - 1).box.x1 - place(over).box.x0};
    if (widest_entry(scene_, bar_) > room.width) return false;
    const double needed = add_legend(scene_, bar_, {room.left, 0.0, room.width}, nullptr);
    if (needed > bottom - top) return false;
    legend_room_ = {room.left, top + 0.5 * (bottom - top - needed), room.width};
    return true;
  }

  void set_scale_bar() {
    bar_ = {};
    if (!scene_.scale_bar || count_ == 0) return;
    const double pt_per_m = place(0).box.width() / (place(0).x_max - place(0).x_min);
    bar_.metres = round_below(0.16 * place(0).box.width() / pt_per_m);
    bar_.length_pt = bar_.metres * pt_per_m;
  }

  void draw() {
    const double size = kTitleSize * em_;
    for (std::size_t k = 0; k < title_.size(); ++k)
      add_text({0.5 * out_.width, (1.55 + 1.35 * static_cast<double>(k)) * em_}, 0.5, title_[k], size, false,
               out_.shapes);
    for (int i = 0; i < count_; ++i) {
      const PanelLayout p = place(i);
      if (panel(i).axes) add_grid(panel(i), p, out_.shapes);
      add_items(panel(i), i, p, em_, out_.shapes);
      if (panel(i).axes) add_frame(p, {left_axis(i), bottom_axis(i)}, em_, out_.shapes);
      const std::vector<std::string> title = wrap_text(panel(i).title, p.box.width() / em_, kTitleLines);
      for (std::size_t k = 0; k < title.size(); ++k) {
        const double up = (0.4 + kLineHeight * static_cast<double>(title.size() - 1 - k)) * em_;
        add_text({0.5 * (p.box.x0 + p.box.x1), p.box.y0 - up}, 0.5, title[k], em_, false, out_.shapes);
      }
    }
    add_legend(scene_, bar_, legend_room_, &out_.shapes);
    out_.scale_bar_m = bar_.metres, out_.scale_bar_pt = bar_.length_pt;
  }

  const Scene& scene_;
  double em_;
  int count_, columns_, rows_;
  std::vector<std::string> title_;              ///< of the scene, line by line
  std::vector<std::size_t> title_lines_;        ///< most lines of each panel's title so far
  std::vector<std::size_t> x_lines_, y_lines_;  ///< most lines of the labels of each panel's axes so far
  std::vector<double> widest_label_;            ///< of each panel's y axis so far [pt]
  std::vector<PanelLayout> natural_;            ///< ranges before they grow to fill their boxes
  ScaleBar bar_;
  LegendRoom legend_room_;
  Layout out_;
};

}  // namespace

Layout layout(const Scene& scene) {
  Layout placed = Composer(scene).compose();
  if (scene.dark) darken(placed.shapes, placed.width, placed.height);
  return placed;
}

}  // namespace scanbench::render
