// A scene laid out once, for all backends: shapes and texts in points (1/72 in) on paper, origin top left, y down.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "render/layout/ticks.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

struct Rect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  bool contains(const Vec2& p) const { return p.x() >= x0 && p.x() <= x1 && p.y() >= y0 && p.y() <= y1; }
};

/// Polylines of one style. Path k is points[starts[k]] .. points[starts[k + 1] - 1].
struct StrokeShape {
  std::vector<Vec2> points{};
  std::vector<std::size_t> starts{0};
  Stroke stroke{};
  bool closed = false;
  bool round = true;  ///< caps and joins; else butt ends, for axes

  std::size_t paths() const { return starts.size() - 1; }
  void end_path();  ///< of the points pushed since the last one; drops a path of one point
};

/// Contours of one colour. Convex ones may overlap; others are filled by the even-odd rule.
struct FillShape {
  std::vector<Vec2> points{};
  std::vector<std::size_t> starts{0};
  Color color{};
  bool convex = true;
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
  bool upwards = false;  ///< turned by 90 degrees: reads from bottom to top
  bool halo = false;
  Color color{};
};

struct Shape {
  std::variant<StrokeShape, FillShape, DotsShape, TextShape> what;
  int clip = -1;  ///< index of the panel whose box cuts it off; -1: none
};

/// Where a panel's data stand on paper.
struct PanelLayout {
  Rect box{};
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;  ///< of the data at the box's sides
  bool x_log = false, y_log = false;
  std::vector<Tick> x_ticks{}, y_ticks{};

  /// Data to paper. Not finite for a coordinate that is not, or is <= 0 on a log axis.
  Vec2 to_device(const Vec2& data) const;
};

struct Layout {
  double width = 0, height = 0;
  std::vector<PanelLayout> panels{};  ///< as in the scene
  std::vector<Shape> shapes{};        ///< in drawing order
  double scale_bar_m = 0;             ///< 0: none
  double scale_bar_pt = 0;
};

Layout layout(const Scene& scene);

// ---- parts of layout(), each in a file of its own

/// The items of a panel as shapes cut off at its box; labels go where they cover least.
void add_items(const Panel& panel, int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes);

/// Bounding box of the items' finite coordinates; x0 > x1 if there are none. On log axes of the positive ones.
Rect data_bounds(const Panel& panel);

/// Puts the legend and the scale bar in centred rows from `top` on and returns where they end. Draws if `shapes` is not
/// null.
double add_legend(const Scene& scene, double scale_bar_m, double scale_bar_pt, double width, double top,
                  std::vector<Shape>* shapes);

/// A marker's shapes about points on paper.
void add_markers(const std::vector<Vec2>& centers, Marker marker, double size_pt, Color color, bool filled, int clip,
                 std::vector<Shape>& shapes);

/// An arrow on paper: dot at `from`, head at the end of `along` (a vector in points).
void add_arrow(const Vec2& from, const Vec2& along, const Stroke& stroke, int clip, std::vector<Shape>& shapes);

/// A movable label: its point, text and wish, and where it may stand.
struct Label {
  const Text* text;
  Vec2 at{};
};

/// Places labels one after the other; each takes the position around its point that covers least of `segments` (pairs
/// of points), `dots` and the labels before it, inside `box`. Returns their rectangles, in the same order.
std::vector<Rect> place_labels(const std::vector<Label>& labels, double font_pt, const Rect& box,
                               const std::vector<Vec2>& segments, const std::vector<Vec2>& dots);

}  // namespace scanbench::render
