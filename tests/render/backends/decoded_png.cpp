// Reads a PNG file with libpng.
#include "decoded_png.hpp"

#include <gtest/gtest.h>

#include <png.h>

namespace scanbench::render::test {

Color DecodedPng::at(int x, int y) const {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {rgb.at(i), rgb.at(i + 1), rgb.at(i + 2)};
}

DecodedPng decode_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << "not a PNG file: " << &image.message[0];
    return {};
  }
  image.format = PNG_FORMAT_RGB;
  DecodedPng decoded{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  decoded.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, decoded.rgb.data(), 0, nullptr) == 0) {
    ADD_FAILURE() << "broken PNG file: " << &image.message[0];
    return {};
  }
  return decoded;
}

}  // namespace scanbench::render::test
