// Colours of the figures: Okabe and Ito, "Color universal design", 2008; safe for colour-blind readers and in print.
#pragma once

#include <cstddef>

#include "render/scene.hpp"

namespace scanbench::render {

inline constexpr Color kBlue{0x00, 0x72, 0xB2};
inline constexpr Color kVermillion{0xD5, 0x5E, 0x00};
inline constexpr Color kGreen{0x00, 0x9E, 0x73};
inline constexpr Color kPurple{0xCC, 0x79, 0xA7};
inline constexpr Color kOrange{0xE6, 0x9F, 0x00};
inline constexpr Color kSky{0x56, 0xB4, 0xE9};
inline constexpr Color kYellow{0xF0, 0xE4, 0x42};

/// How a method looks in every figure: by its place in the scenario. Eight colours; the ninth method has the first
/// colour again with another dash and marker.
struct MethodStyle {
  Color color;
  Dash dash;
  Marker marker;
};
MethodStyle method_style(std::size_t index);

/// Mixed with white: 0 gives the colour, 1 white.
Color lighten(Color color, double share);

}  // namespace scanbench::render
