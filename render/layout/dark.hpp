// Figures on a dark ground: the colours of a finished layout, turned over.
#pragma once

#include <vector>

#include "render/paper/shapes.hpp"
#include "render/scene.hpp"

namespace scanbench::render {

/// The ground of dark figures, which is what white becomes.
inline constexpr Color kDarkGround{24, 27, 31};

/// The colour of the same hue with its lightness turned over: white becomes the ground, black nearly white, a tint of a
/// colour a shade of it. Light colours of methods, which are not tints, stay light.
Color dark_color(Color color);

/// Turns over every colour of the shapes on paper of this size, in points, and adds the ground behind them.
void darken(std::vector<Shape>& shapes, double width, double height);

}  // namespace scanbench::render
