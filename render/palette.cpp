// Okabe-Ito palette, darkest and most different colours first; yellow, hard to see on white, last.
#include "render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanbench::render {

MethodStyle method_style(std::size_t index) {
  constexpr std::array kColors{kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack, kYellow};
  constexpr std::array kDashes{Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
  constexpr std::array kMarkers{Marker::circle, Marker::square,        Marker::triangle, Marker::diamond,
                                Marker::plus,   Marker::triangle_down, Marker::cross};
  // 8, 4 and 7 repeat together only after 56 methods; the dash moves on with each round of colours.
  return {kColors[index % kColors.size()], kDashes[(index + index / kColors.size()) % kDashes.size()],
          kMarkers[index % kMarkers.size()]};
}

Color lighten(Color color, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [s](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c + (255.0 - c) * s)); };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace scanbench::render
