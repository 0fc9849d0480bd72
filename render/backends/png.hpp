// PNG files in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scanbench::render {

/// `rgb`: rows from top to bottom, 3 bytes per pixel; `width`, `height` > 0. The size on paper is written into the
/// file, so that a page shows the picture at its size. The same pixels give the same bytes. Throws InternalError if
/// libpng fails.
std::string encode_png(std::span<const std::uint8_t> rgb, int width, int height, double dpi);

}  // namespace scanbench::render
