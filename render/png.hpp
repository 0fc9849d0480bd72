// PNG files in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scanbench::render {

/// `bgr`: rows from top to bottom, 3 bytes a pixel. The size on paper is written into the file.
std::string encode_png(const std::vector<std::uint8_t>& bgr, int width, int height, double dpi);

}  // namespace scanbench::render
