// Markers and arrows on paper.
#pragma once

#include <vector>

#include "render/paper/shapes.hpp"

namespace scanbench::render {

/// A marker's shapes around points on paper.
void add_markers(const std::vector<Vec2>& centers, Marker marker, double size_pt, Color color, bool filled, int clip,
                 std::vector<Shape>& shapes);

/// An arrow on paper: dot at `from`, head at the end of `along` (a vector in points).
void add_arrow(const Vec2& from, const Vec2& along, const Stroke& stroke, int clip, std::vector<Shape>& shapes);

}  // namespace scanbench::render
