// Chunks of the APNG specification (PNG, third edition, section 11.3.4): acTL announces the frames, fcTL begins each,
// fdAT holds the data of all but the first. libpng compresses each frame as a file of its own, from which they come.
#include "render/backends/apng.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "render/backends/png.hpp"

namespace scanbench::render {
namespace {

constexpr double kScreenDpi = 96.0;

std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFFU);
  return text;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string chunk(std::string_view type, const std::string& data) {
  const std::string body = std::string(type) + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size()), 4) + body + big_endian(static_cast<std::uint32_t>(crc), 4);
}

/// Calls `use` with the type, the data and all bytes of every chunk of a PNG file.
template <class Use>
void for_each_chunk(std::string_view png, const Use& use) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t size = number_at(png, at);
    use(png.substr(at + 4, 4), png.substr(at + 8, size), png.substr(at, size + 12));
    at += size + 12;
  }
}

struct Box {
  int x0, y0, x1, y1;  // x1 and y1 are one beyond
};

/// The smallest rectangle with all pixels that differ; one pixel if none does.
Box changed(const Pixels& a, const Pixels& b) {
  Box box{b.width, b.height, 0, 0};
  const auto row_bytes = static_cast<std::ptrdiff_t>(3) * b.width;
  for (int y = 0; y < b.height; ++y) {
    const auto first = b.rgb.begin() + y * row_bytes, last = first + row_bytes;
    const auto other = a.rgb.begin() + y * row_bytes;
    const auto left = std::mismatch(first, last, other).first;
    if (left == last) continue;
    auto right = last;
    while (*(right - 1) == *(other + (right - 1 - first))) --right;
    box.x0 = std::min(box.x0, static_cast<int>((left - first) / 3));
    box.x1 = std::max(box.x1, static_cast<int>((right - first + 2) / 3));
    box.y0 = std::min(box.y0, y);
    box.y1 = y + 1;
  }
  return box.x1 > box.x0 ? box : Box{0, 0, 1, 1};
}

std::vector<std::uint8_t> part(const Pixels& frame, const Box& box) {
  std::vector<std::uint8_t> rgb;
  for (int y = box.y0; y < box.y1; ++y) {
    const auto row =
        frame.rgb.begin() + static_cast<std::ptrdiff_t>(3) * (static_cast<std::ptrdiff_t>(y) * frame.width);
    rgb.insert(rgb.end(), row + static_cast<std::ptrdiff_t>(3) * box.x0, row + static_cast<std::ptrdiff_t>(3) * box.x1);
  }
  return rgb;
}

}  // namespace

ApngWriter::ApngWriter(std::uint32_t frames, std::uint16_t fps) : frames_(frames), fps_(fps) {
  SCANBENCH_ASSERT(frames >= 1 && fps >= 1);
}

void ApngWriter::add(const Pixels& frame) {
  const bool first = added_++ == 0;
  SCANBENCH_ASSERT(added_ <= frames_ && (first || (frame.width == before_.width && frame.height == before_.height)));
  const Box box = first ? Box{0, 0, frame.width, frame.height} : changed(before_, frame);
  const int width = box.x1 - box.x0, height = box.y1 - box.y0;
  const std::string png = encode_png(part(frame, box), width, height, kScreenDpi, PngColors::rgb);
  if (first) {
    bytes_ = png.substr(0, 8);
    for_each_chunk(png, [this](std::string_view type, std::string_view, std::string_view whole) {
      if (type == "IHDR" || type == "pHYs") bytes_ += whole;
    });
    bytes_ += chunk("acTL", big_endian(frames_, 4) + big_endian(0, 4));  // plays for ever
  }
  add_control(static_cast<std::uint32_t>(box.x0), static_cast<std::uint32_t>(box.y0), static_cast<std::uint32_t>(width),
              static_cast<std::uint32_t>(height));
  for_each_chunk(png, [&](std::string_view type, std::string_view data, std::string_view whole) {
    if (type != "IDAT") return;
    if (first)
      bytes_ += whole;
    else
      bytes_ += chunk("fdAT", big_endian(sequence_++, 4) + std::string(data));
  });
  before_ = frame;
}

void ApngWriter::add_control(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  bytes_ += chunk("fcTL", big_endian(sequence_++, 4) + big_endian(width, 4) + big_endian(height, 4) + big_endian(x, 4) +
                              big_endian(y, 4) + big_endian(1, 2) + big_endian(fps_, 2) +
                              std::string(2, '\0'));  // the frame stays, and replaces what is below it
}

std::string ApngWriter::finish() {
  SCANBENCH_ASSERT(added_ == frames_);
  return bytes_ + chunk("IEND", "");
}

}  // namespace scanbench::render
