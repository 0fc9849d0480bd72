// The encoder keeps every pixel and writes the size of a pixel.
#include "render/backends/png.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/rng.hpp"
#include "decoded_png.hpp"

namespace scanbench::render {
namespace {

std::vector<std::uint8_t> noise(std::size_t bytes) {
  CounterRng rng(1, RngStream::pose);
  std::vector<std::uint8_t> rgb(bytes);
  for (std::uint8_t& byte : rgb) byte = static_cast<std::uint8_t>(256.0 * rng.uniform());
  return rgb;
}

TEST(EncodePng, KeepsEveryPixelAndTheirOrder) {
  for (const auto& [width, height] : {std::array{1, 1}, std::array{3, 2}, std::array{257, 31}, std::array{31, 257}}) {
    const std::vector<std::uint8_t> rgb =
        noise(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const test::DecodedPng decoded = test::decode_png(encode_png(rgb, width, height, 200));
    EXPECT_EQ(decoded.width, width);
    EXPECT_EQ(decoded.height, height);
    EXPECT_EQ(decoded.rgb, rgb);
  }
}

/// A picture of 40 x 20 pixels with this many colours, each once or more.
std::vector<std::uint8_t> colors(int count) {
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 800; ++i) {
    const int color = i / 3 < count ? i / 3 : i % count;
    rgb.insert(rgb.end(), {static_cast<std::uint8_t>(color % 256), static_cast<std::uint8_t>(color / 256),
                           static_cast<std::uint8_t>(255 - color % 256)});
  }
  return rgb;
}

// PNG specification, 11.2.2: the colour type is byte 25 of the file; 3 is a list of colours, 2 red, green and blue.
TEST(EncodePng, ListsTheColoursOfAPictureOfAtMost256) {
  for (const auto& [count, type] : {std::pair(1, 3), std::pair(2, 3), std::pair(256, 3), std::pair(257, 2)}) {
    const std::string png = encode_png(colors(count), 40, 20, 200);
    EXPECT_EQ(png.at(25), type) << count << " colours";
    EXPECT_EQ(test::decode_png(png).rgb, colors(count)) << count << " colours";
  }
}

// PNG specification, 11.3.5.3: pixels per metre in x and in y, big-endian, and the unit 1.
TEST(EncodePng, WritesTheSizeOfAPixelInMetres) {
  const std::string png = encode_png(noise(12), 2, 2, 254.0);  // 10 000 pixels per metre, 0x2710
  EXPECT_NE(png.find(std::string("pHYs\0\0\x27\x10\0\0\x27\x10\x01", 13)), std::string::npos);
}

}  // namespace
}  // namespace scanbench::render
