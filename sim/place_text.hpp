// Coordinates in error messages: metres, rounded to the millimetre.
#pragma once

#include <cmath>
#include <string>

#include "core/geometry/geometry.hpp"
#include "core/number_text.hpp"

namespace scanbench::sim {

inline std::string metres_text(double metres) {
  return number_text(std::floor(metres * 1000.0 + 0.5) / 1000.0);
}

/// "(1.25, -0.3) m".
inline std::string place_text(const Vec2& p) {
  std::string text = "(";
  text += metres_text(p.x());
  text += ", ";
  text += metres_text(p.y());
  text += ") m";
  return text;
}

}  // namespace scanbench::sim
