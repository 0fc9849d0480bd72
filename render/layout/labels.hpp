// Labels beside points, where they cover least.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "render/paper/shapes.hpp"

namespace scanbench::render {

/// A text and its point on paper.
struct Label {
  const Text* text;
  Vec2 at{};
};

/// The line from a point to its label at `placed`; nullopt if the label is beside its point or may not move.
std::optional<Segment> leader_of(const Label& label, const Rect& placed);

/// Places labels one after the other; each takes the position around its point that covers least of `segments` (pairs
/// of points), `dots`, the labels before it and the lines that lead to them, inside `box`. Returns their rectangles, in
/// the same order.
std::vector<Rect> place_labels(const std::vector<Label>& labels, double font_pt, const Rect& box,
                               const std::vector<Vec2>& segments, const std::vector<Vec2>& dots);

}  // namespace scanbench::render
