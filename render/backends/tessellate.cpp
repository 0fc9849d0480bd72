// Converts shapes to triangles: thick lines to quads with round joins, discs to polygons, letters and polygons to
// trapezoids.
#include "render/backends/tessellate.hpp"

#include <algorithm>
#include <cmath>

#include "render/paper/fill_triangles.hpp"
#include "render/paper/font.hpp"
#include "render/paper/stroke_style.hpp"

namespace scanbench::render {
namespace {

class Tessellator {
 public:
  explicit Tessellator(double px_per_pt) : px_per_pt_(px_per_pt) {}

  std::vector<TriangleBatch> run(const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      clip_ = shape.clip;
      std::visit([this](const auto& s) { add(s); }, shape.what);
    }
    return std::move(batches_);
  }

 private:
  void begin() {
    if (batches_.empty() || batches_.back().clip != clip_) batches_.push_back({.clip = clip_});
  }

  void triangle(const Vec2& p, const Vec2& q, const Vec2& r) {
    for (const Vec2* v : {&p, &q, &r})
      batches_.back().vertices.push_back(
          {static_cast<float>(v->x()), static_cast<float>(v->y()), color_.r, color_.g, color_.b, 255});
  }

  void disc(const Vec2& c, double radius) {
    const int n = std::clamp(static_cast<int>(4.0 + 2.0 * std::sqrt(radius * px_per_pt_)), 6, 48);
    if (n != corners_) {
      corners_ = n;
      unit_.clear();
      for (int i = 0; i < n; ++i) unit_.emplace_back(std::cos(kTwoPi * i / n), std::sin(kTwoPi * i / n));
    }
    // The radius grows so that the polygon has the disc's area.
    const double r = radius * std::sqrt(kTwoPi / (n * std::sin(kTwoPi / n)));
    for (std::size_t i = 1; i + 1 < unit_.size(); ++i)
      triangle(c + r * unit_[0], c + r * unit_[i], c + r * unit_[i + 1]);
  }

  void quad(const Vec2& p, const Vec2& q, double half_width) {
    const Vec2 d = q - p;
    const double n = d.norm();
    if (!(n > 0)) return;
    const Vec2 side = perpendicular(d) * (half_width / n);
    triangle(p + side, p - side, q + side);
    triangle(q + side, p - side, q - side);
  }

  /// One path; `closed` adds the edge back to its start.
  void path(const std::vector<Vec2>& points, bool closed, double width, bool round) {
    const double half = 0.5 * width;
    const std::size_t n = points.size(), edges = closed ? n : n - 1;
    // Below four pixels of the oversampled raster a square end that is a little longer looks round.
    const bool tiny = half * px_per_pt_ < 4.0;
    const double longer = !round && !closed ? 0.0 : round ? (tiny ? 0.6 * half : 0.0) : half;  // closed: square corners
    for (std::size_t i = 0; i < edges; ++i) {
      const Vec2 &p = points[i], &q = points[(i + 1) % n];
      const double length = (q - p).norm();
      const Vec2 end = length > 0 ? Vec2((q - p) * (longer / length)) : Vec2(Vec2::Zero());
      quad(p - end, q + end, half);
    }
    const bool point = n == 2 && points[0] == points[1];
    if (round && (!tiny || point))
      for (const Vec2& p : points) disc(p, half);
  }

  void dashed(const std::vector<Vec2>& points, bool closed, double width, const DashPattern& dash) {
    const std::size_t n = points.size(), edges = closed ? n : n - 1;
    int phase = 0;
    double left = dash.lengths[0];
    std::vector<Vec2> piece{points[0]};
    const auto flush = [&] {
      if (piece.size() >= 2) {
        for (std::size_t i = 0; i + 1 < piece.size(); ++i) quad(piece[i], piece[i + 1], 0.5 * width);
        for (std::size_t i = 1; i + 1 < piece.size(); ++i) disc(piece[i], 0.5 * width);
      }
      piece.clear();
    };
    for (std::size_t i = 0; i < edges; ++i) {
      const Vec2 &p = points[i], &q = points[(i + 1) % n];
      const double length = (q - p).norm();
      if (!(length > 0)) continue;
      for (double at = 0.0; at < length;) {
        const double step = std::min(left, length - at);
        at += step;
        left -= step;
        const Vec2 here = p + (q - p) * (at / length);
        if (phase % 2 == 0) piece.push_back(here);
        if (left <= 1e-9) {
          if (phase % 2 == 0) flush();
          phase = (phase + 1) % dash.count;
          left = dash.lengths[static_cast<std::size_t>(phase)];
          if (phase % 2 == 0) piece.push_back(here);
        }
      }
    }
    flush();
  }

  void add(const StrokeShape& s) {
    begin();
    color_ = s.stroke.color;
    const DashPattern dash = dash_pattern(s.stroke);
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < s.paths(); ++k) {
      points.assign(s.points.begin() + static_cast<std::ptrdiff_t>(s.starts[k]),
                    s.points.begin() + static_cast<std::ptrdiff_t>(s.starts[k + 1]));
      if (dash.count > 0)
        dashed(points, s.closed, s.stroke.width_pt, dash);
      else
        path(points, s.closed, s.stroke.width_pt, s.round);
    }
  }

  /// Adds the triangles of a convex polygon.
  void fan(const Vec2* points, std::size_t count) {
    for (std::size_t i = 1; i + 1 < count; ++i) triangle(points[0], points[i], points[i + 1]);
  }

  void add(const FillShape& s) {
    begin();
    color_ = s.color;
    std::vector<std::vector<Vec2>> contours;
    for (std::size_t k = 0; k + 1 < s.starts.size(); ++k) {
      const Vec2* points = s.points.data() + s.starts[k];
      const std::size_t n = s.starts[k + 1] - s.starts[k];
      if (s.convex)
        fan(points, n);
      else
        contours.emplace_back(points, points + n);
    }
    const std::vector<Vec2> corners = fill_triangles(contours, true);
    for (std::size_t i = 0; i < corners.size(); i += 3) triangle(corners[i], corners[i + 1], corners[i + 2]);
  }

  void add(const DotsShape& s) {
    begin();
    color_ = s.color;
    for (const Vec2& c : s.centers) disc(c, 0.5 * s.diameter);
  }

  void add(const TextShape& s) {
    begin();
    const std::vector<const Glyph*> glyphs = Font::get().shape(s.text);
    double x = 0.0;
    const auto placed = [&](const Vec2& p) {
      const Vec2 v((x + p.x()) * s.size, p.y() * s.size);  // y up
      return Vec2(s.origin + (s.upwards ? Vec2(-v.y(), -v.x()) : Vec2(v.x(), -v.y())));
    };
    if (s.halo) {
      color_ = s.halo_color;
      std::vector<Vec2> rim;
      for (const Glyph* g : glyphs) {
        for (const auto& contour : g->contours) {
          rim.clear();
          for (const Vec2& p : contour) rim.push_back(placed(p));
          path(rim, true, 2 * kHaloPt, true);
        }
        x += g->advance_em;
      }
    }
    color_ = s.color;
    x = 0.0;
    for (const Glyph* g : glyphs) {
      for (std::size_t i = 0; i < g->triangles.size(); i += 3)
        triangle(placed(g->triangles[i]), placed(g->triangles[i + 1]), placed(g->triangles[i + 2]));
      x += g->advance_em;
    }
  }

  double px_per_pt_;
  int clip_ = -1;
  Color color_;
  int corners_ = 0;
  std::vector<Vec2> unit_;
  std::vector<TriangleBatch> batches_;
};

}  // namespace

std::vector<TriangleBatch> tessellate(const std::vector<Shape>& shapes, double px_per_pt) {
  return Tessellator(px_per_pt).run(shapes);
}

}  // namespace scanbench::render
