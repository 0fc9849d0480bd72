// The items of a panel as shapes on paper.
#pragma once

#include <vector>

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

/// Shapes cut off at the panel's box; labels go where they cover least.
void add_items(const Panel& panel, int index, const PanelLayout& place, double font_pt, std::vector<Shape>& shapes);

}  // namespace scanbench::render
