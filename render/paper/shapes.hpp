// Shapes on paper, which every backend draws: in points (1/72 in), origin top left, y down.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

struct Rect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  bool contains(const Vec2& p) const { return p.x() >= x0 && p.x() <= x1 && p.y() >= y0 && p.y() <= y1; }
  Rect grown(double margin) const { return {x0 - margin, y0 - margin, x1 + margin, y1 + margin}; }
};

/// Cuts the segment p-q at the rectangle; false if nothing of it is inside.
bool cut(Vec2& p, Vec2& q, const Rect& rect);

/// Polylines of one style. Path k is points[starts[k]] .. points[starts[k + 1] - 1].
struct StrokeShape {
  std::vector<Vec2> points{};
  std::vector<std::size_t> starts{0};
  Stroke stroke{};
  bool closed = false;
  bool round = true;  ///< caps and joins; else butt ends, for axes

  std::size_t paths() const { return starts.size() - 1; }
  void end_path();  ///< of the points pushed since the last one; drops a path of one point
  void add_segment(const Vec2& a, const Vec2& b);  ///< a path of its own
};

/// Contours of one colour. Convex ones may overlap; others are filled by the even-odd rule.
struct FillShape {
  std::vector<Vec2> points{};
  std::vector<std::size_t> starts{0};
  Color color{};
  bool convex = true;

  void end_contour() { starts.push_back(points.size()); }
};

/// Discs of one size.
struct DotsShape {
  std::vector<Vec2> centers{};
  double diameter = 1.0;
  Color color{};
};

/// A text run from the left end of its baseline.
struct TextShape {
  Vec2 origin{};
  std::string text{};
  double size = 8.0;
  bool upwards = false;  ///< rotated by 90 degrees: reads from bottom to top
  bool halo = false;
  Color color{};
  Color halo_color = kWhite;
};

struct Shape {
  std::variant<StrokeShape, FillShape, DotsShape, TextShape> what;
  int clip = -1;  ///< index of the panel whose box cuts it off; -1: none
};

}  // namespace scanbench::render
