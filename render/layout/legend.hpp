// The legend and the scale bar of a scene.
#pragma once

#include <vector>

#include "render/paper/shapes.hpp"

namespace scanbench::render {

/// Puts the legend and the scale bar in centred rows from `top` on and returns where they end. Draws if `shapes` is not
/// null.
double add_legend(const Scene& scene, double scale_bar_m, double scale_bar_pt, double width, double top,
                  std::vector<Shape>* shapes);

}  // namespace scanbench::render
