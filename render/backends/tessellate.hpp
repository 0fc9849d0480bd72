// Shapes as triangles: what the OpenGL backend draws.
#pragma once

#include <cstdint>
#include <vector>

#include "render/paper/shapes.hpp"

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

/// `px_per_pt`: of the raster, for the number of corners of a disc.
std::vector<TriangleBatch> tessellate(const std::vector<Shape>& shapes, double px_per_pt);

}  // namespace scanbench::render
