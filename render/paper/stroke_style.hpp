// Dashes and halos, which all backends draw alike.
#pragma once

#include <algorithm>
#include <array>

#include "render/scene.hpp"

namespace scanbench::render {

/// White rim of a text with a halo.
inline constexpr double kHaloPt = 1.1;

struct DashPattern {
  std::array<double, 4> lengths{};  ///< on, off, ... in points
  int count = 0;                    ///< 0: solid
};

/// Dashes grow with the width, but stay long enough to be distinguished on paper.
inline DashPattern dash_pattern(const Stroke& stroke) {
  const double w = std::max(stroke.width_pt, 0.6);
  switch (stroke.dash) {
    case Dash::dashed:
      return {{4.5 * w, 2.2 * w}, 2};
    case Dash::dotted:
      return {{1.2 * w, 1.8 * w}, 2};
    case Dash::dash_dot:
      return {{5.0 * w, 1.8 * w, 1.2 * w, 1.8 * w}, 4};
    default:
      return {};
  }
}

}  // namespace scanbench::render
