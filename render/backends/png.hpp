// PNG files in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scanbench::render {

/// Pictures of at most 256 colours list them, which makes smaller files; the frames of an animated PNG share one header
/// and must not.
enum class PngColors { listed_if_few, rgb };

/// `rgb`: rows from top to bottom, 3 bytes per pixel; `width`, `height` > 0. The size on paper is written into the
/// file, so that a page shows the picture at its size. The same pixels give the same bytes. Throws InternalError if
/// libpng fails.
std::string encode_png(std::span<const std::uint8_t> rgb, int width, int height, double dpi,
                       PngColors colors = PngColors::listed_if_few);

}  // namespace scanbench::render
