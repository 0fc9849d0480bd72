// Shapes of each kind of item.
#include "render/layout/items.hpp"

#include <algorithm>
#include <cmath>

#include "render/layout/labels.hpp"
#include "render/layout/markers.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

/// To a grid too fine to see (1/32 pt = 0.01 mm): shorter numbers in SVG and PDF.
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
    // Through the data transform, so that the arrow points along its data direction whatever the aspect.
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
    StrokeShape shape{.stroke = item.stroke, .round = false};
    for (const auto& [x, low, high] : item.intervals) {
      if (!drawable({x, low}) || !drawable({x, high})) continue;
      const Vec2 a = place_.to_device({x, low}), b = place_.to_device({x, high}), cap(0.5 * item.cap_pt, 0);
      for (const auto& [p, q] : {std::pair{a, b}, {Vec2(a - cap), Vec2(a + cap)}, {Vec2(b - cap), Vec2(b + cap)}}) {
        push_segment(p, q, shape);
        shape.end_path();
      }
    }
    push(std::move(shape));
  }

  void place_texts() {
    const std::vector<Rect> rects = place_labels(labels_, font_pt_, box_, segments_, dots_);
    const double cap = Font::get().cap_height_em();
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const Text& text = *labels_[i].text;
      const Rect& r = rects[i];
      const Vec2 at = labels_[i].at;
      const Vec2 nearest(std::clamp(at.x(), r.x0, r.x1), std::clamp(at.y(), r.y0, r.y1));
      if (text.movable && (nearest - at).norm() > 1.9 * std::max(text.offset_pt.norm(), 3.0)) {
        StrokeShape leader{.stroke = {kGrey, 0.35, Dash::solid}};
        leader.add_segment(snap(at), snap(nearest));
        shapes_.push_back({std::move(leader), index_});
      }
      const double size = font_pt_ * text.scale;
      const Vec2 origin = text.upwards ? Vec2(0.5 * (r.x0 + r.x1) + 0.5 * cap * size, r.y1 - 0.5)
                                       : Vec2(r.x0 + 0.5, 0.5 * (r.y0 + r.y1) + 0.5 * cap * size);
      shapes_.push_back({TextShape{snap(origin), text.text, size, text.upwards, text.halo, text.color}, index_});
    }
  }

 private:
  /// Far outside is as good as a box away: keeps the backends' fixed-point numbers small. Exact for axis-parallel
  /// edges; a slanted edge that leaves the paper turns a little outside the clip.
  Vec2 near_box(const Vec2& p) const {
    const double m = 4.0 * (box_.width() + box_.height());
    return snap({std::clamp(p.x(), box_.x0 - m, box_.x1 + m), std::clamp(p.y(), box_.y0 - m, box_.y1 + m)});
  }

  void push_segment(Vec2 a, Vec2 b, StrokeShape& shape) {
    if (!drawable(a) || !drawable(b)) return;
    const double margin = shape.stroke.width_pt;  // so that a cut end's cap lies outside the clip
    if (!cut(a, b, box_.grown(margin))) return;
    a = snap(a), b = snap(b);
    segments_.insert(segments_.end(), {a, b});
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
        segments_.insert(segments_.end(), {place_.to_device(points[i]), place_.to_device(points[(i + 1) % n])});
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

  void push(StrokeShape shape) {
    if (!shape.points.empty()) shapes_.push_back({std::move(shape), index_});
  }

  int index_;
  const PanelLayout& place_;
  double font_pt_;
  std::vector<Shape>& shapes_;
  Rect box_;
  std::vector<Vec2> segments_, dots_;  // what labels should not cover
  std::vector<Label> labels_;
};

}  // namespace

void add_items(const Panel& panel, int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes) {
  ItemDrawer drawer(index, place, font_pt, shapes);
  for (const Item& item : panel.items) std::visit([&](const auto& i) { drawer.draw(i); }, item);
  drawer.place_texts();
}

}  // namespace scanbench::render
