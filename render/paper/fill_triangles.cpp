// Sweeps over horizontal bands: between two levels of corners no edge begins or ends, so each band is a row of
// trapezoids.
#include "render/paper/fill_triangles.hpp"

#include <algorithm>

namespace scanbench::render {

std::vector<Vec2> fill_triangles(const std::vector<std::vector<Vec2>>& contours, bool even_odd) {
  struct Edge {
    Vec2 low, high;  // by y
    int winding;
    double x_at(double y) const { return low.x() + (high.x() - low.x()) * ((y - low.y()) / (high.y() - low.y())); }
  };
  std::vector<Edge> edges;
  std::vector<double> levels;
  for (const auto& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
      levels.push_back(a.y());
      if (a.y() < b.y()) edges.push_back({a, b, 1});
      if (a.y() > b.y()) edges.push_back({b, a, -1});
    }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  std::vector<Vec2> triangles;
  std::vector<const Edge*> band;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    const double y0 = levels[k], y1 = levels[k + 1], middle = 0.5 * (y0 + y1);
    band.clear();
    for (const Edge& e : edges)
      if (e.low.y() <= y0 && e.high.y() >= y1) band.push_back(&e);
    std::sort(band.begin(), band.end(),
              [&](const Edge* a, const Edge* b) { return a->x_at(middle) < b->x_at(middle); });
    int winding = 0;
    for (std::size_t i = 0; i + 1 < band.size(); ++i) {
      winding += even_odd ? 1 : band[i]->winding;
      if (even_odd ? winding % 2 == 0 : winding == 0) continue;
      const Edge &l = *band[i], &r = *band[i + 1];
      const Vec2 a(l.x_at(y0), y0), b(r.x_at(y0), y0), c(l.x_at(y1), y1), d(r.x_at(y1), y1);
      triangles.insert(triangles.end(), {a, b, c, c, b, d});
    }
  }
  return triangles;
}

}  // namespace scanbench::render
