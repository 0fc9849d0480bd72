// Labels beside points, where they cover least.
#pragma once

#include <vector>

#include "render/paper/shapes.hpp"

namespace scanbench::render {

/// A text and its point on paper.
struct Label {
  const Text* text;
  Vec2 at{};
};

/// Places labels one after the other; each takes the position around its point that covers least of `segments` (pairs
/// of points), `dots` and the labels before it, inside `box`. Returns their rectangles, in the same order.
std::vector<Rect> place_labels(const std::vector<Label>& labels, double font_pt, const Rect& box,
                               const std::vector<Vec2>& segments, const std::vector<Vec2>& dots);

}  // namespace scanbench::render
