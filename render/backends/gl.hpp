// Scenes as PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

/// The whole scene as the bytes of a file. The same scene gives the same bytes in every thread and process. Throws
/// ConfigError if the font (DejaVu Sans) or OSMesa is not installed, or if the picture would be larger than 20 000
/// pixels per side; InternalError if a library fails.
std::string to_png(const Scene& scene, double dpi = 300.0);

/// The same as pixels, rows from top to bottom with 3 bytes per pixel.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Pixels to_pixels(const Scene& scene, double dpi);

}  // namespace scanbench::render
