// Animated PNG: every frame can be put together again from the file.
#include "render/backends/apng.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "decoded_png.hpp"

namespace scanbench::render {
namespace {

struct Chunk {
  std::string type, data;
};

std::uint32_t number(const std::string& bytes, std::size_t at, int length = 4) {
  std::uint32_t value = 0;
  for (int i = 0; i < length; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return value;
}

/// The chunks of a file, whose check sums must be right.
std::vector<Chunk> chunks(const std::string& file) {
  std::vector<Chunk> found;
  EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number(file, at);
    const std::string body = file.substr(at + 4, size + 4);
    EXPECT_EQ(number(file, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
    found.push_back({body.substr(0, 4), body.substr(4)});
    at += size + 12;
  }
  return found;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  std::string out;
  const auto put = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      out += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
  };
  const std::string body = type + data;
  put(static_cast<std::uint32_t>(data.size()));
  out += body;
  put(static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
  return out;
}

Pixels frame(int width, int height, std::pair<int, int> dot) {
  Pixels pixels{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 255)};
  const auto at = static_cast<std::size_t>(3 * (dot.second * width + dot.first));
  pixels.rgb[at] = 200, pixels.rgb[at + 1] = 10, pixels.rgb[at + 2] = 0;
  return pixels;
}

std::string film(const std::vector<Pixels>& frames) {
  ApngWriter writer(static_cast<std::uint32_t>(frames.size()), 12);
  for (const Pixels& pixels : frames) writer.add(pixels);
  return writer.finish();
}

TEST(Apng, FramesCanBePutTogetherAgain) {
  const std::vector<Pixels> frames{frame(40, 30, {3, 4}), frame(40, 30, {20, 25}), frame(40, 30, {20, 25}),
                                   frame(40, 30, {39, 29}), frame(40, 30, {0, 0})};
  const auto found = chunks(film(frames));
  ASSERT_EQ(found.front().type, "IHDR");
  std::uint32_t sequence = 0, shown = 0;
  std::vector<std::uint8_t> canvas;
  std::string control;
  for (const Chunk& chunk : found) {
    if (chunk.type == "acTL") {
      EXPECT_EQ(number(chunk.data, 0), frames.size());
    }
    if (chunk.type == "fcTL") {
      control = chunk.data;
      EXPECT_EQ(number(control, 0), sequence++);
      EXPECT_EQ(number(control, 20, 2), 1U);   // a twelfth
      EXPECT_EQ(number(control, 22, 2), 12U);  // of a second
    }
    if (chunk.type != "IDAT" && chunk.type != "fdAT") continue;
    std::string data = chunk.data;
    if (chunk.type == "fdAT") {
      EXPECT_EQ(number(data, 0), sequence++);
      data.erase(0, 4);
    }
    // The data of a frame as a file of its own.
    const std::string header = control.substr(4, 8) + found.front().data.substr(8);
    const auto part = test::decode_png("\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", data) +
                                       png_chunk("IEND", ""));
    const auto x = static_cast<int>(number(control, 12)), y = static_cast<int>(number(control, 16));
    if (shown == 0) canvas.assign(static_cast<std::size_t>(3 * part.width * part.height), 0);
    for (int v = 0; v < part.height; ++v)
      for (int u = 0; u < part.width; ++u) {
        const Color color = part.at(u, v);
        const auto at = static_cast<std::size_t>(3 * ((y + v) * 40 + x + u));
        canvas.at(at) = color.r, canvas.at(at + 1) = color.g, canvas.at(at + 2) = color.b;
      }
    EXPECT_EQ(canvas, frames.at(shown).rgb) << "frame " << shown;
    ++shown;
  }
  EXPECT_EQ(shown, frames.size());
}

TEST(Apng, ShowsItsFirstFrameToProgramsThatKnowOnlyPng) {
  const auto decoded = test::decode_png(film({frame(8, 8, {1, 2}), frame(8, 8, {5, 5})}));
  EXPECT_EQ(decoded.at(1, 2), (Color{200, 10, 0}));
  EXPECT_EQ(decoded.at(5, 5), kWhite);
}

TEST(Apng, OfEqualFramesHasEqualBytes) {
  const std::vector<Pixels> frames{frame(16, 16, {1, 1}), frame(16, 16, {2, 2})};
  EXPECT_EQ(film(frames), film(frames));
}

}  // namespace
}  // namespace scanbench::render
