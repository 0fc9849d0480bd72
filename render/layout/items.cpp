// Converts each kind of item to shapes.
#include "render/layout/items.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/layout/labels.hpp"
#include "render/layout/markers.hpp"
#include "render/paper/font.hpp"
#include "render/paper/stroke_style.hpp"

namespace scanbench::render {
namespace {

/// Rounds to a grid too fine to see (1/32 pt = 0.01 mm), which gives shorter numbers in SVG and PDF.
Vec2 snap(const Vec2& p, double steps_per_pt = 32.0) {
  return {std::round(p.x() * steps_per_pt) / steps_per_pt, std::round(p.y() * steps_per_pt) / steps_per_pt};
}

class ItemDrawer {
 public:
  ItemDrawer(int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes)
      : index_(index), place_(place), font_pt_(font_pt), shapes_(shapes), box_(place.box) {}

  void draw(const Lines& item) {
    StrokeShape shape{.stroke = item.stroke};
    for (const Segment& s : item.segments) {
      if (!drawable(s.a) || !drawable(s.b)) continue;
      lines_outside_ += box_.contains(place_.to_device(s.a)) && box_.contains(place_.to_device(s.b)) ? 0 : 1;
      push_segment(place_.to_device(s.a), place_.to_device(s.b), shape);
      shape.end_path();
    }
    push(std::move(shape));
  }

  void draw(const Polyline& item) {
    StrokeShape shape{.stroke = item.stroke};
    push_polyline(item.points, item.closed, shape);
    push(std::move(shape));
  }

  void draw(const Points& item) {
    std::vector<Vec2> centers;
    const double r = item.marker == Marker::dot ? 0.0 : 0.5 * item.size_pt;
    for (const Vec2& p : item.points) {
      if (!drawable(p)) continue;
      const Vec2 c = place_.to_device(p);
      dots_outside_ += item.marker == Marker::dot && !box_.contains(c) ? 1 : 0;
      if (!drawable(c) || c.x() < box_.x0 - r || c.x() > box_.x1 + r || c.y() < box_.y0 - r || c.y() > box_.y1 + r)
        continue;
      // Dots nearer than a quarter of a point are one dot to the eye.
      centers.push_back(item.marker == Marker::dot ? snap(c, 4.0) : snap(c));
    }
    if (item.marker == Marker::dot) {
      const auto before = [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); };
      std::sort(centers.begin(), centers.end(), before);
      centers.erase(std::unique(centers.begin(), centers.end()), centers.end());
    }
    if (item.marker == Marker::dot && item.size_pt <= 2.0)
      for (std::size_t i = 0; i < centers.size(); i += 1 + centers.size() / 2000) dots_.push_back(centers[i]);
    else
      dots_.insert(dots_.end(), centers.begin(), centers.end());
    add_markers(centers, item.marker, item.size_pt, item.color, item.filled, index_, shapes_);
  }

  void draw(const Polygon& item) {
    std::vector<Vec2> points;
    for (const Vec2& p : item.points)
      if (drawable(p) && drawable(place_.to_device(p))) points.push_back(p);
    if (points.size() >= 3) {
      FillShape shape{.color = item.fill, .convex = false};
      for (const Vec2& p : points) shape.points.push_back(near_box(place_.to_device(p)));
      shape.end_contour();
      shapes_.push_back({std::move(shape), index_});
    }
    if (item.outline) draw(Polyline{points, *item.outline, true});
  }

  void draw(const Ellipse& item) {
    if (!drawable(item.center) || !drawable(item.semi_axes) || !std::isfinite(item.angle_rad)) return;
    constexpr int kCorners = 72;
    std::vector<Vec2> points;
    const Pose2 frame(item.center, item.angle_rad);
    for (int i = 0; i < kCorners; ++i) {
      const double t = kTwoPi * i / kCorners;
      points.push_back(frame * Vec2(item.semi_axes.x() * std::cos(t), item.semi_axes.y() * std::sin(t)));
    }
    if (item.fill)
      draw(Polygon{points, *item.fill, item.stroke});
    else
      draw(Polyline{points, item.stroke, true});
  }

  void draw(const Text& item) {
    if (item.text.empty() || !drawable(item.at)) return;
    const Vec2 at = place_.to_device(item.at);
    if (drawable(at) && box_.contains(at)) labels_.push_back({&item, at});
  }

  void draw(const Arrow& item) {
    if (!drawable(item.pose.translation())) return;
    const Vec2 from = place_.to_device(item.pose.translation());
    if (!drawable(from) || !box_.contains(from)) return;
    // Through the data transform, so that the arrow points along its data direction for any aspect.
    const Vec2 ahead = place_.to_device(item.pose * Vec2(1e-3, 0)) - from;
    const double n = ahead.norm();
    if (!(n > 0)) return;
    const Vec2 along = ahead * (item.length_pt / n);
    segments_.insert(segments_.end(), {from, from + along});
    dots_.push_back(from);
    add_arrow(snap(from), along, item.stroke, index_, shapes_);
  }

  void draw(const Bars& item) {
    FillShape shape{.color = item.fill};
    for (const Vec2& top : item.tops) {
      const double base = place_.y_log ? place_.y_min : item.base;
      const Vec2 corner1(top.x() - 0.5 * item.width, base), corner2(top.x() + 0.5 * item.width, top.y());
      if (!drawable(corner1) || !drawable(corner2)) continue;
      const Vec2 a = place_.to_device(corner1), b = place_.to_device(corner2);
      if (!drawable(a) || !drawable(b)) continue;
      const Vec2 p = near_box(a), q = near_box(b);
      shape.points.insert(shape.points.end(), {p, Vec2(q.x(), p.y()), q, Vec2(p.x(), q.y())});
      shape.end_contour();
    }
    if (!shape.points.empty()) shapes_.push_back({std::move(shape), index_});
  }

  void draw(const ErrorBars& item) {
    StrokeShape bars{.stroke = item.stroke, .round = false};
    FillShape arrows{.color = item.stroke.color};
    constexpr double kBesideFrame = 1.0;  // pt; on the frame a cap cannot be seen
    const double half = 0.5 * item.cap_pt;
    for (const auto& [x, low, high] : item.intervals) {
      if (std::isnan(low) || std::isnan(high) || !drawable({x, 0.0})) continue;
      const double px = place_.to_device({x, place_.y_min}).x();
      if (!(px >= box_.x0 && px <= box_.x1)) continue;
      const double bottom = bar_end(low), top = bar_end(high);
      push_segment({px, bottom}, {px, top}, bars);
      bars.end_path();
      for (const double end : {bottom, top}) {
        if (end >= box_.y0 && end <= box_.y1) {
          const double cap = std::clamp(end, box_.y0 + kBesideFrame, box_.y1 - kBesideFrame);
          push_segment({px - half, cap}, {px + half, cap}, bars);
        } else
          push_edge_arrow(px, end < box_.y0, half, arrows);
        bars.end_path();
      }
    }
    push(std::move(bars));
    if (!arrows.points.empty()) shapes_.push_back({std::move(arrows), index_});
  }

  /// Writes into the lower left corner how many items are outside.
  void tell_outside(const Panel& panel) {
    const int count = panel.tell_outside == "line" ? lines_outside_ : dots_outside_;
    if (panel.tell_outside.empty() || count == 0) return;
    outside_ = {.text = fmt::format("{} {}{} outside", count, panel.tell_outside, count == 1 ? "" : "s"),
                .offset_pt = {2.5, 2.5},
                .color = kGrey,
                .movable = false};
    labels_.insert(labels_.begin(), Label{&outside_, {box_.x0, box_.y1}});
  }

  /// Draws halos, then the solid lines below them again, then the texts, so that a halo hides no wall.
  void place_texts() {
    const std::vector<Rect> rects = place_labels(labels_, font_pt_, box_, segments_, dots_);
    for (std::size_t i = 0; i < labels_.size(); ++i) add_leader(labels_[i], rects[i]);
    for (std::size_t i = 0; i < labels_.size(); ++i)
      if (labels_[i].text->halo) {
        shapes_.push_back({text_shape(*labels_[i].text, rects[i], true), index_});
        add_solid_lines_again(rects[i].grown(2 * kHaloPt));
      }
    for (std::size_t i = 0; i < labels_.size(); ++i)
      shapes_.push_back({text_shape(*labels_[i].text, rects[i], false), index_});
  }

 private:
  /// A line from a label to its point, if the label is not beside it.
  void add_leader(const Label& label, const Rect& placed) {
    const auto line = leader_of(label, placed);
    if (!line) return;
    StrokeShape leader{.stroke = {kGrey, 0.35, Dash::solid}};
    leader.add_segment(snap(line->a), snap(line->b));
    shapes_.push_back({std::move(leader), index_});
  }

  TextShape text_shape(const Text& text, const Rect& r, bool halo) const {
    const double half_cap = 0.5 * Font::get().cap_height_em() * font_pt_;
    const Vec2 origin = text.upwards ? Vec2(0.5 * (r.x0 + r.x1) + half_cap, r.y1 - 0.5)
                                     : Vec2(r.x0 + 0.5, 0.5 * (r.y0 + r.y1) + half_cap);
    return {snap(origin), text.text, font_pt_, text.upwards, halo, text.color};
  }

  void add_solid_lines_again(const Rect& under) {
    for (const SolidLine& line : solid_lines_) {
      Vec2 a = line.a, b = line.b;
      if (!cut(a, b, under)) continue;
      StrokeShape shape{.stroke = line.stroke};
      shape.add_segment(a, b);
      shapes_.push_back({std::move(shape), index_});
    }
  }

  /// Height of an error bar's end on paper; beyond the box if the axis does not contain the value.
  double bar_end(double value) const {
    const double beyond = box_.width() + box_.height();
    if (place_.y_log && !(value > 0)) return box_.y1 + beyond;
    return std::clamp(place_.to_device({place_.x_min, value}).y(), box_.y0 - beyond, box_.y1 + beyond);
  }

  /// An arrow head at the upper or lower edge of the box, which shows that the bar continues.
  void push_edge_arrow(double x, bool up, double half, FillShape& arrows) const {
    const double tip = up ? box_.y0 + 0.5 : box_.y1 - 0.5, back = tip + (up ? 2.0 : -2.0) * half;
    arrows.points.insert(arrows.points.end(), {Vec2(x, tip), Vec2(x - half, back), Vec2(x + half, back)});
    arrows.end_contour();
  }

  /// Moves points far outside nearer to the box, to keep the backends' fixed-point numbers small. This is exact for
  /// axis-parallel edges; a slanted edge that leaves the paper changes its direction a little outside the clip.
  Vec2 near_box(const Vec2& p) const {
    const double m = 4.0 * (box_.width() + box_.height());
    return snap({std::clamp(p.x(), box_.x0 - m, box_.x1 + m), std::clamp(p.y(), box_.y0 - m, box_.y1 + m)});
  }

  void push_segment(Vec2 a, Vec2 b, StrokeShape& shape) {
    if (!drawable(a) || !drawable(b)) return;
    const double margin = shape.stroke.width_pt;  // so that the cap of a cut end is outside the clip
    if (!cut(a, b, box_.grown(margin))) return;
    a = snap(a), b = snap(b);
    add_obstacle(a, b, shape.stroke);
    const bool continues = shape.points.size() > shape.starts.back() && shape.points.back() == a;
    if (!continues) {
      shape.end_path();
      shape.points.push_back(a);
    }
    shape.points.push_back(b);
  }

  void push_polyline(const std::vector<Vec2>& points, bool closed, StrokeShape& shape) {
    const std::size_t n = points.size();
    bool whole = closed && n >= 3;  // a closed path that nothing cuts stays one closed path, joined at its ends
    for (const Vec2& p : points) whole = whole && drawable(p) && box_.contains(place_.to_device(p));
    shape.closed = whole;
    if (whole) {
      for (std::size_t i = 0; i < n; ++i) {
        shape.points.push_back(snap(place_.to_device(points[i])));
        add_obstacle(place_.to_device(points[i]), place_.to_device(points[(i + 1) % n]), shape.stroke);
      }
      shape.end_path();
      return;
    }
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
      const Vec2 &a = points[i], &b = points[(i + 1) % n];
      if (drawable(a) && drawable(b)) push_segment(place_.to_device(a), place_.to_device(b), shape);
    }
    shape.end_path();
  }

  /// A line that labels should not cover.
  void add_obstacle(const Vec2& a, const Vec2& b, const Stroke& stroke) {
    segments_.insert(segments_.end(), {a, b});
    if (stroke.dash == Dash::solid) solid_lines_.push_back({a, b, stroke});
  }

  void push(StrokeShape shape) {
    if (!shape.points.empty()) shapes_.push_back({std::move(shape), index_});
  }

  int index_;
  const PanelLayout& place_;
  double font_pt_;
  std::vector<Shape>& shapes_;
  Rect box_;
  struct SolidLine {
    Vec2 a, b;
    Stroke stroke;
  };
  std::vector<Vec2> segments_, dots_;  // what labels should not cover
  std::vector<SolidLine> solid_lines_;
  std::vector<Label> labels_;
  int dots_outside_ = 0, lines_outside_ = 0;
  Text outside_;
};

}  // namespace

void add_items(const Panel& panel, int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes) {
  ItemDrawer drawer(index, place, font_pt, shapes);
  for (const Item& item : panel.items) std::visit([&](const auto& i) { drawer.draw(i); }, item);
  drawer.tell_outside(panel);
  drawer.place_texts();
}

}  // namespace scanbench::render
