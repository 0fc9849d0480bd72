// Places labels by a greedy choice among fixed positions around the point, after Christensen, Marks & Shieber, "An
// empirical study of algorithms for point-feature label placement", ACM ToG 14(3), 1995, section 2 (without annealing:
// figures here have tens of labels, not thousands).
#include "render/layout/labels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

double overlap(const Rect& a, const Rect& b) {
  const double w = std::min(a.x1, b.x1) - std::max(a.x0, b.x0);
  const double h = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
  return w > 0 && h > 0 ? w * h : 0.0;
}

double length_inside(Vec2 p, Vec2 q, const Rect& r) {
  return cut(p, q, r) ? (q - p).norm() : 0.0;
}

/// The rectangle of size 2 half whose nearest edge is `offset` from p.
Rect rect_beside(const Vec2& p, const Vec2& offset, const Vec2& half) {
  const double n = offset.norm();
  const auto lean = [n](double c) { return n > 0 ? std::clamp(1.5 * c / n, -1.0, 1.0) : 0.0; };
  const Vec2 c = p + offset + Vec2(lean(offset.x()) * half.x(), lean(offset.y()) * half.y());
  return {c.x() - half.x(), c.y() - half.y(), c.x() + half.x(), c.y() + half.y()};
}

/// Cost of a line that leads to one label and runs through another, which then seems to be its label.
double crossing(const std::optional<Segment>& leader, const Rect& label) {
  return leader && length_inside(leader->a, leader->b, label) > 0 ? 50.0 : 0.0;
}

/// Cost of a label on a line.
double covered(const Vec2& p, const Vec2& q, const Rect& label) {
  const double length = length_inside(p, q, label);
  return length > 0 ? 24.0 + 2.0 * length : 0.0;
}

/// Cost of a leader across a line, except where it begins.
double crossed(const std::optional<Segment>& leader, const Vec2& p, const Vec2& q) {
  if (!leader) return 0.0;
  const Vec2 along = leader->b - leader->a, line = q - p, to_line = p - leader->a;
  const double area = cross(along, line);
  if (area == 0.0) return 0.0;
  const double on_leader = cross(to_line, line) / area, on_line = cross(to_line, along) / area;
  return on_leader * along.norm() > 1.5 && on_leader <= 1.0 && on_line >= 0.0 && on_line <= 1.0 ? 6.0 : 0.0;
}

/// Moves the rectangle into the box; leaves it unchanged if the box is too small.
Rect inside(Rect r, const Rect& box) {
  const double dx = r.width() > box.width() ? 0 : std::max(0.0, box.x0 - r.x0) - std::max(0.0, r.x1 - box.x1);
  const double dy = r.height() > box.height() ? 0 : std::max(0.0, box.y0 - r.y0) - std::max(0.0, r.y1 - box.y1);
  return {r.x0 + dx, r.y0 + dy, r.x1 + dx, r.y1 + dy};
}

}  // namespace

std::optional<Segment> leader_of(const Label& label, const Rect& placed) {
  const Vec2 nearest(std::clamp(label.at.x(), placed.x0, placed.x1), std::clamp(label.at.y(), placed.y0, placed.y1));
  const bool beside = (nearest - label.at).norm() <= 1.9 * std::max(label.text->offset_pt.norm(), 3.0);
  return label.text->movable && !beside ? std::optional(Segment{label.at, nearest}) : std::nullopt;
}

std::vector<Rect> place_labels(const std::vector<Label>& labels, double font_pt, const Rect& box,
                               const std::vector<Vec2>& segments, const std::vector<Vec2>& dots) {
  const Font& font = Font::get();
  std::vector<Rect> placed;
  placed.reserve(labels.size());
  std::vector<std::optional<Segment>> leaders;  // of the labels placed so far
  leaders.reserve(labels.size());
  const Rect room{box.x0 + 1.5, box.y0 + 1.5, box.x1 - 1.5, box.y1 - 1.5};
  for (const Label& label : labels) {
    Vec2 half(0.5 * font.width_em(label.text->text) * font_pt + 0.5, 0.5 * font.cap_height_em() * font_pt + 0.8);
    if (label.text->upwards) std::swap(half.x(), half.y());
    const Vec2 wish(label.text->offset_pt.x(), -label.text->offset_pt.y());
    if (!label.text->movable) {
      placed.push_back(rect_beside(label.at, wish, half));
      leaders.emplace_back();
      continue;
    }
    const double reach = std::max(wish.norm(), 1.0);
    const double heading = wish.norm() > 0 ? std::atan2(wish.y(), wish.x()) : -kPi / 2;
    Rect best;
    double best_cost = INFINITY;
    for (const double far : {1.0, 2.0, 3.5, 5.5, 8.0, 11.0, 14.0})
      for (const double turn : {0.0, 22.5, -22.5, 45.0, -45.0, 180.0, 90.0, -90.0, 135.0, -135.0}) {
        const double a = heading + radians(turn);
        const Rect wanted = rect_beside(label.at, far * reach * Vec2(std::cos(a), std::sin(a)), half);
        const Rect r = inside(wanted, room);
        const Rect grown = r.grown(1);
        // Weights: a label on a label cannot be read, one on a line is hard to read.
        double cost = 4.0 * (far - 1.0) + 0.02 * std::abs(turn);
        cost += 4.0 * (std::abs(r.x0 - wanted.x0) + std::abs(r.y0 - wanted.y0));
        const std::optional<Segment> leader = leader_of(label, r);
        for (std::size_t i = 0; i < placed.size(); ++i)
          cost += 20.0 * overlap(grown, placed[i]) + crossing(leader, placed[i]) + crossing(leaders[i], grown);
        for (std::size_t i = 0; i + 1 < segments.size(); i += 2)
          cost += covered(segments[i], segments[i + 1], grown) + crossed(leader, segments[i], segments[i + 1]);
        for (const Vec2& p : dots)
          if (grown.contains(p)) cost += 1.5;
        if (cost < best_cost) best = r, best_cost = cost;
      }
    placed.push_back(best);
    leaders.push_back(leader_of(label, best));
  }
  return placed;
}

}  // namespace scanbench::render
