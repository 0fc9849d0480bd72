// Ticks, grid and frame of a panel.
#pragma once

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

/// Round numbers along both axes of a box whose ranges are set; `em`: size of the font in points.
void choose_ticks(const Panel& panel, double em, PanelLayout& place);

/// Room for tick labels and axis label below a labelled box.
double bottom_room(const Panel& panel, double em);

void add_grid(const Panel& panel, const PanelLayout& place, std::vector<Shape>& shapes);
void add_frame(const Panel& panel, const PanelLayout& place, LabelledSides sides, double em,
               std::vector<Shape>& shapes);

/// A text run on paper; `align`: the share of its length that is before (x, y).
void add_text(const Vec2& at, double align, const std::string& text, double size, bool upwards,
              std::vector<Shape>& shapes);

}  // namespace scanbench::render
