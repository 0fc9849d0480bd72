// PNG encoder through libpng. Rows are not filtered and compressed at level 2: in line drawings, where most pixels are
// white, this takes a third of the time of the default level for a fifth more bytes, and filters make files larger. A
// picture of at most 256 colours, as most line drawings are, has one byte per pixel and a list of its colours: a third
// of the bytes to compress.
#include "render/backends/png.hpp"

#include <png.h>

#include <array>
#include <cmath>
#include <csetjmp>
#include <exception>
#include <optional>
#include <vector>

#include "core/error.hpp"

namespace scanbench::render {
namespace {

constexpr int kCompressionLevel = 2;

constexpr std::size_t kMostColors = 256;

/// Indices into a list of colours, one per pixel.
struct IndexedPixels {
  std::vector<png_color> colors;  ///< in the order of their first pixels
  std::vector<std::uint8_t> indices;
};

std::uint32_t color_of(const std::uint8_t* rgb) {
  return static_cast<std::uint32_t>(rgb[0]) << 16U | static_cast<std::uint32_t>(rgb[1]) << 8U | rgb[2];
}

/// None if there are more than kMostColors.
std::optional<IndexedPixels> indexed(std::span<const std::uint8_t> rgb) {
  constexpr std::uint32_t kFree = 0xFFFFFFFFU;
  std::array<std::uint32_t, 4 * kMostColors> keys{};  // a hash table with open addressing
  std::array<std::uint8_t, keys.size()> values{};
  keys.fill(kFree);
  IndexedPixels out;
  out.indices.resize(rgb.size() / 3);
  std::uint32_t last = kFree;
  std::uint8_t index = 0;
  for (std::size_t i = 0; i < out.indices.size(); ++i) {
    const std::uint32_t color = color_of(&rgb[3 * i]);
    if (color != last) {  // most pixels are like the one before
      std::size_t at = (color * 2654435761U) >> 22U;
      while (keys[at] != color && keys[at] != kFree) at = (at + 1) % keys.size();
      if (keys[at] == kFree) {
        if (out.colors.size() == kMostColors) return std::nullopt;
        keys[at] = color;
        values[at] = static_cast<std::uint8_t>(out.colors.size());
        out.colors.push_back({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
      }
      index = values[at];
      last = color;
    }
    out.indices[i] = index;
  }
  return out;
}

struct Image {
  const std::uint8_t* pixels;         ///< rows from top to bottom
  std::span<const png_color> colors;  ///< empty: pixels are red, green, blue; else indices
  png_uint_32 width, height;
  png_uint_32 pixels_per_metre;
};

struct Output {
  std::string bytes;
  std::string error;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  auto* out = static_cast<Output*>(png_get_io_ptr(png));
  try {
    out->bytes.append(reinterpret_cast<const char*>(data), size);
    return;
  } catch (const std::exception&) {  // an exception must not pass through C code
  }
  png_error(png, "no memory");
}

void flush(png_structp) {}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<Output*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

/// False if libpng failed; it reports errors with longjmp, so nothing here has a destructor.
bool write(png_structp png, png_infop info, const Image& image, Output& out) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: the only error report that libpng has
  png_set_write_fn(png, &out, append, flush);
  const bool listed = !image.colors.empty();
  png_set_IHDR(png, info, image.width, image.height, 8, listed ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (listed) png_set_PLTE(png, info, image.colors.data(), static_cast<int>(image.colors.size()));
  png_set_pHYs(png, info, image.pixels_per_metre, image.pixels_per_metre, PNG_RESOLUTION_METER);
  png_set_filter(png, PNG_FILTER_TYPE_DEFAULT, PNG_FILTER_NONE);
  png_set_compression_level(png, kCompressionLevel);
  png_write_info(png, info);
  const std::size_t row = std::size_t{listed ? 1U : 3U} * image.width;
  for (png_uint_32 y = 0; y < image.height; ++y) png_write_row(png, image.pixels + row * y);
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string encode_png(std::span<const std::uint8_t> rgb, int width, int height, double dpi, PngColors colors) {
  SCANBENCH_ASSERT(width > 0 && height > 0);
  SCANBENCH_ASSERT(rgb.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const std::optional<IndexedPixels> listed = colors == PngColors::rgb ? std::nullopt : indexed(rgb);
  const Image image{listed ? listed->indices.data() : rgb.data(),
                    listed ? std::span<const png_color>(listed->colors) : std::span<const png_color>(),
                    static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                    static_cast<png_uint_32>(std::lround(dpi / 0.0254))};
  Output out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &out, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool written = info != nullptr && write(png, info, image, out);
  png_destroy_write_struct(&png, &info);
  if (!written) throw InternalError("libpng: " + (out.error.empty() ? "no memory" : out.error));
  return std::move(out.bytes);
}

}  // namespace scanbench::render
