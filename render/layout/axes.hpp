// Ticks, grid and frame of a panel.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

inline constexpr double kTickLengthPt = 2.5;

/// Which sides of a panel carry tick labels and the axis label.
struct LabelledSides {
  bool left = true;
  bool bottom = true;
};

/// Round numbers along both axes of a box whose ranges are set, in the unit that suits them, and the labels with that
/// unit; `em`: size of the font in points.
void choose_ticks(const Panel& panel, double em, PanelLayout& place);

/// The labels of the axes, broken into lines that fit beside the box.
std::vector<std::string> x_label_lines(const PanelLayout& place, double em);
std::vector<std::string> y_label_lines(const PanelLayout& place, double em);

/// Room below a labelled box for its tick labels and an axis label of `lines` lines.
double bottom_room(std::size_t lines, double em);
/// Room left of the tick labels for an axis label of `lines` lines.
double left_label_room(std::size_t lines, double em);

void add_grid(const Panel& panel, const PanelLayout& place, std::vector<Shape>& shapes);
void add_frame(const PanelLayout& place, LabelledSides sides, double em, std::vector<Shape>& shapes);

/// A text run on paper; `align`: the share of its length that is before (x, y).
void add_text(const Vec2& at, double align, const std::string& text, double size, bool upwards,
              std::vector<Shape>& shapes);

}  // namespace scanbench::render
