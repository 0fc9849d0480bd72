// Areas inside closed contours as triangles: letters and polygons.
#pragma once

#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::render {

/// Triangles (three points each) of the area inside closed contours: where the winding number is not zero, or odd.
/// Exact for contours whose edges do not cross; horizontal cuts only, so that no seam shows between the pieces.
std::vector<Vec2> fill_triangles(const std::vector<std::vector<Vec2>>& contours, bool even_odd);

}  // namespace scanbench::render
