// Colours of the figures: Okabe and Ito, "Color universal design", 2008; safe for colour-blind readers and in print.
// Without their yellow, whose contrast to white is 1.3: no thin line of it can be seen on paper. That of the others is
// 2.2 or more; darker ones would be harder to distinguish.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

inline constexpr Color kBlue{0x00, 0x72, 0xB2};
inline constexpr Color kVermillion{0xD5, 0x5E, 0x00};
inline constexpr Color kGreen{0x00, 0x9E, 0x73};
inline constexpr Color kPurple{0xCC, 0x79, 0xA7};
inline constexpr Color kOrange{0xE6, 0x9F, 0x00};
inline constexpr Color kSky{0x56, 0xB4, 0xE9};

/// How a method looks in every figure.
struct MethodStyle {
  Color color;
  Dash dash = Dash::solid;
  Marker marker = Marker::circle;
  bool operator==(const MethodStyle&) const = default;
};

/// By the name alone, so that a method looks alike in every scenario: one of 196 looks of seven colours. Two names may
/// share a colour, seldom a whole look.
MethodStyle method_style(std::string_view name);

/// The same for the methods of one figure. Up to seven methods have different colours, more have different looks: where
/// two share a colour by their names, the first in the alphabet keeps it, and the other one takes the next that is
/// free.
std::vector<MethodStyle> method_styles(std::span<const std::string> names);

/// Mixed with white: 0 gives the colour, 1 white.
Color lighten(Color color, double share);

}  // namespace scanbench::render
