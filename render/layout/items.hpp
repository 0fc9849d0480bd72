// Converts the items of a panel to shapes on paper.
#pragma once

#include <vector>

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

/// Adds the shapes of all items, cut off at the panel's box. Labels are placed where they cover least.
void add_items(const Panel& panel, int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes);

}  // namespace scanbench::render
