// Builds paths of strokes, and cuts a segment at a rectangle by Liang & Barsky, "A new concept and method for line
// clipping", ACM ToG 3(1), 1984.
#include "render/paper/shapes.hpp"

#include <algorithm>

namespace scanbench::render {

bool cut(Vec2& p, Vec2& q, const Rect& rect) {
  double t0 = 0, t1 = 1;
  const Vec2 d = q - p;
  const auto side = [&](double slope, double room) {  // keeps the t with slope * t <= room
    if (slope == 0) return room >= 0;
    const double t = room / slope;
    if (slope < 0)
      t0 = std::max(t0, t);
    else
      t1 = std::min(t1, t);
    return t0 <= t1;
  };
  if (!side(-d.x(), p.x() - rect.x0) || !side(d.x(), rect.x1 - p.x()) || !side(-d.y(), p.y() - rect.y0) ||
      !side(d.y(), rect.y1 - p.y()))
    return false;
  const Vec2 start = p;
  if (t1 < 1) q = start + t1 * d;
  if (t0 > 0) p = start + t0 * d;
  return true;
}

void StrokeShape::end_path() {
  if (points.size() == starts.back() + 1) points.pop_back();
  if (points.size() > starts.back()) starts.push_back(points.size());
}

void StrokeShape::add_segment(const Vec2& a, const Vec2& b) {
  points.insert(points.end(), {a, b});
  end_path();
}

}  // namespace scanbench::render
