// The legend and the scale bar of a scene.
#pragma once

#include <vector>

#include "render/paper/shapes.hpp"

namespace scanbench::render {

struct ScaleBar {
  double metres = 0.0;
  double length_pt = 0.0;  ///< 0: none
};

/// The room of a legend: as wide as given, as high as it needs.
struct LegendRoom {
  double left = 0.0, top = 0.0, width = 0.0;
};

/// The room that the widest entry needs so that its text is not shortened.
double widest_entry(const Scene& scene, const ScaleBar& scale_bar);

/// Puts the legend and the scale bar in centred rows and returns where they end. Draws if `shapes` is not null.
double add_legend(const Scene& scene, const ScaleBar& scale_bar, const LegendRoom& room, std::vector<Shape>* shapes);

}  // namespace scanbench::render
