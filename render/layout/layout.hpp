// A scene laid out once, for all backends.
#pragma once

#include <vector>

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

struct Layout {
  double width = 0, height = 0;       ///< [pt]
  std::vector<PanelLayout> panels{};  ///< as in the scene
  std::vector<Shape> shapes{};        ///< in drawing order
  double scale_bar_m = 0;             ///< 0: none
  double scale_bar_pt = 0;
};

Layout layout(const Scene& scene);

}  // namespace scanbench::render
