// A scene: a plain draw list of panels in data coordinates. Backends draw the same scene as PNG, SVG and PDF.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench::render {

/// Opaque sRGB. There is no transparency: overlapping strokes then look alike in every backend.
struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};
inline constexpr Color kBlack{0, 0, 0};
inline constexpr Color kWhite{255, 255, 255};
inline constexpr Color kGrey{110, 110, 110};
inline constexpr Color kFaint{190, 190, 190};

enum class Dash { solid, dashed, dotted, dash_dot };
enum class Marker { none, dot, circle, square, diamond, triangle, triangle_down, plus, cross };

struct Stroke {
  Color color = kBlack;
  double width_pt = 0.8;
  Dash dash = Dash::solid;
};

// ---- items of a panel, in data coordinates, drawn in order; those with non-finite coordinates are left out

struct Lines {
  std::vector<Segment> segments{};
  Stroke stroke{};
};

/// A point that is not finite breaks the line.
struct Polyline {
  std::vector<Vec2> points{};
  Stroke stroke{};
  bool closed = false;
};

struct Points {
  std::vector<Vec2> points{};
  Marker marker = Marker::dot;
  Color color = kBlack;
  double size_pt = 1.0;
  bool filled = true;  ///< else an outline on white
};

struct Polygon {
  std::vector<Vec2> points{};
  Color fill = kFaint;
  std::optional<Stroke> outline{};
};

/// A circle if the semi-axes are equal.
struct Ellipse {
  Vec2 center = Vec2::Zero();
  Vec2 semi_axes = Vec2::Ones();
  double angle_rad = 0.0;  ///< of the first semi-axis
  Stroke stroke{};
  std::optional<Color> fill{};
};

/// Text beside a point. `offset_pt` points from there to the nearest edge of the text, y up.
struct Text {
  Vec2 at = Vec2::Zero();
  std::string text{};
  Vec2 offset_pt{0.0, 3.0};
  Color color = kBlack;
  bool halo = true;     ///< a white rim under it, which covers points and dashed lines but no solid line
  bool movable = true;  ///< may be put on another side of its point if it would cover a line, a marker or another label
  bool upwards = false;  ///< rotated by 90 degrees: reads from bottom to top
};

/// A pose: a dot at its origin and an arrow along its x axis, of a length on paper.
struct Arrow {
  Pose2 pose{};
  double length_pt = 14.0;
  Stroke stroke{};
};

/// Vertical bars from `base` to y.
struct Bars {
  std::vector<Vec2> tops{};
  double width = 0.8;  ///< in data units of x
  double base = 0.0;
  Color fill = kGrey;
};

/// Vertical intervals [low, high] at x with end caps; an end outside the panel is an arrow at its edge.
struct ErrorBars {
  std::vector<std::array<double, 3>> intervals{};  ///< x, low, high
  Stroke stroke{};
  double cap_pt = 4.0;
};

using Item = std::variant<Lines, Polyline, Points, Polygon, Ellipse, Text, Arrow, Bars, ErrorBars>;

struct Axis {
  std::string label{};  ///< "position error", or with a unit that does not change: "x [m]"
  /// Of the data: "m", "us", "deg". The numbers may be written in another one (layout/shown_unit.hpp), which then
  /// follows the label: "position error [mm]".
  std::string unit{};
  std::optional<std::pair<double, double>> range{};     ///< absent: from the items, with a margin
  bool log = false;                                     ///< decades; values <= 0 are left out
  std::vector<std::pair<double, std::string>> ticks{};  ///< absent: round numbers
  bool grid = true;
};

/// Room around the data of a panel for letters of its own, in em: they keep their size when the panel shrinks.
struct LetterRoom {
  double left = 0.0, right = 0.0, below = 0.0, above = 0.0;
};

/// One set of axes with its items.
struct Panel {
  std::string title{};
  Axis x{.label = "x [m]"};
  Axis y{.label = "y [m]"};
  bool axes = true;          ///< false: no box, ticks and grid, because the items draw their own
  bool equal_aspect = true;  ///< a metre is as long in x as in y: ranges grow to fill the box
  LetterRoom room{};         ///< of a panel with equal aspect
  /// "point" or "line": the number of dots, or of segments with an end, outside the box is written into a corner, if
  /// any.
  std::string tell_outside{};
  std::vector<Item> items{};
};

/// A swatch with a text, below the panels or in free cells of their grid: never over the data.
struct LegendEntry {
  std::string text{};
  std::optional<Stroke> stroke{};
  Marker marker = Marker::none;
  Color marker_color = kBlack;
  double marker_size_pt = 4.0;
  bool marker_filled = true;
  std::optional<Color> fill{};  ///< a box, for bars and polygons
  bool arrow = false;           ///< a pose arrow in the stroke's colour
};

inline constexpr double kSingleColumnIn = 3.5;
inline constexpr double kDoubleColumnIn = 7.16;

/// Small multiples: panels row by row on a grid. Sizes are those on paper.
struct Scene {
  double width_in = kSingleColumnIn;
  double height_in = 0.0;  ///< 0: as the content needs
  double max_height_in = 8.5;
  double font_pt = 8.0;  ///< of all texts but the title, which is larger
  std::string title{};
  std::vector<Panel> panels{};
  int columns = 0;           ///< 0: at most three, chosen by the number of panels
  bool share_axes = false;   ///< all panels have one range; tick labels are at the outer edges only
  double box_aspect = 0.66;  ///< height over width of panels without equal aspect
  std::vector<LegendEntry> legend{};
  bool scale_bar = false;  ///< a bar of a round length in metres beside the legend
  bool dark = false;       ///< light lines on a dark ground (layout/dark.hpp)
};

}  // namespace scanbench::render
