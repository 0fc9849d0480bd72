// Shapes as triangles: what the OpenGL backend draws.
#pragma once

#include <cstdint>
#include <vector>

#include "render/layout/layout.hpp"

namespace scanbench::render {

struct Vertex {
  float x, y;  ///< points on paper
  std::uint8_t r, g, b, a;
};

/// A run of triangles, every three vertices one.
struct TriangleBatch {
  std::vector<Vertex> vertices{};
  int clip = -1;
};

/// Triangles (three points each) of the area inside closed contours: where the winding number is not zero, or odd.
/// Exact for contours whose edges do not cross; horizontal cuts only, so that no seam shows between the pieces.
std::vector<Vec2> fill_triangles(const std::vector<std::vector<Vec2>>& contours, bool even_odd);

/// `px_per_pt`: of the raster, for the number of corners of a disc.
std::vector<TriangleBatch> tessellate(const std::vector<Shape>& shapes, double px_per_pt);

}  // namespace scanbench::render
