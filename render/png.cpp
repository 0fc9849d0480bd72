// PNG through OpenCV's encoder at its default level: higher ones take twice the time for a few per cent of the size.
#include "render/png.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"

namespace scanbench::render {
namespace {

void push_number(std::string& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(v >> shift & 0xFFU));
}

/// CRC-32 of ISO 3309, PNG specification, annex D.
std::uint32_t crc(std::string_view bytes) {
  std::uint32_t c = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xEDB88320U ^ c >> 1 : c >> 1;
  }
  return ~c;
}

/// The chunk that says how large a pixel is (PNG specification, 11.3.5.3), so that a page shows the figure at its size.
std::string physical_size_chunk(double dpi) {
  std::string body = "pHYs";
  const auto per_metre = static_cast<std::uint32_t>(std::lround(dpi / 0.0254));
  push_number(body, per_metre);
  push_number(body, per_metre);
  body.push_back(1);  // per metre
  std::string chunk;
  push_number(chunk, static_cast<std::uint32_t>(body.size() - 4));
  chunk += body;
  push_number(chunk, crc(body));
  return chunk;
}

}  // namespace

std::string encode_png(const std::vector<std::uint8_t>& bgr, int width, int height, double dpi) {
  SCANBENCH_ASSERT(bgr.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  auto* pixels = const_cast<std::uint8_t*>(bgr.data());  // NOLINT: only read
  const cv::Mat image(height, width, CV_8UC3, pixels);
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes)) throw InternalError("OpenCV could not encode a PNG");
  std::string png(bytes.begin(), bytes.end());
  constexpr std::size_t kAfterHeader = 8 + 4 + 4 + 13 + 4;  // signature and the IHDR chunk
  return png.insert(kAfterHeader, physical_size_chunk(dpi));
}

}  // namespace scanbench::render
