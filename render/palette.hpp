// Colours of the figures: Okabe and Ito, "Color universal design", 2008; safe for colour-blind readers and in print.
// Without their yellow, whose contrast to white is 1.3: no thin line of it can be seen on paper. That of the others is
// 2.2 or more; darker ones would be harder to tell apart.
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

/// How a method looks in every figure: by its place in the scenario. Seven colours; the eighth method has the first
/// colour again with another dash and marker.
struct MethodStyle {
  Color color;
  Dash dash = Dash::solid;
  Marker marker = Marker::circle;
};
MethodStyle method_style(std::size_t index);

/// Mixed with white: 0 gives the colour, 1 white.
Color lighten(Color color, double share);

}  // namespace scanbench::render
