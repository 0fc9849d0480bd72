// Okabe-Ito palette without its yellow, most different colours first.
#include "render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanbench::render {

MethodStyle method_style(std::size_t index) {
  constexpr std::array kColors{kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack};
  constexpr std::array kDashes{Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
  constexpr std::array kMarkers{Marker::circle, Marker::square,        Marker::triangle, Marker::diamond,
                                Marker::plus,   Marker::triangle_down, Marker::cross};
  // Dash and marker move on with each round of colours: the three repeat together after 28 rounds.
  const std::size_t round = index / kColors.size();
  const std::size_t color = index % kColors.size();
  return {kColors[color], kDashes[(color + round) % kDashes.size()], kMarkers[(color + round) % kMarkers.size()]};
}

Color lighten(Color color, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [s](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c + (255.0 - c) * s)); };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace scanbench::render
