// Converts shapes to the triangles that the OpenGL backend draws.
#pragma once

#include <cstdint>
#include <vector>

#include "render/paper/shapes.hpp"

namespace scanbench::render {

struct Vertex {
  float x, y;  ///< points on paper
  std::uint8_t r, g, b, a;
};

/// A run of triangles of three vertices each.
struct TriangleBatch {
  std::vector<Vertex> vertices{};
  int clip = -1;
};

/// `px_per_pt` is the resolution of the raster, which determines the number of corners of a disc.
std::vector<TriangleBatch> tessellate(const std::vector<Shape>& shapes, double px_per_pt);

}  // namespace scanbench::render
