// Animated PNG: a PNG file whose first frame every viewer shows, and whose other frames browsers play.
#pragma once

#include <cstdint>
#include <string>

#include "render/backends/gl.hpp"

namespace scanbench::render {

/// Collects the frames of one film. The same frames give the same bytes.
class ApngWriter {
 public:
  /// `frames` >= 1 are announced at the beginning of the file; `fps` >= 1 per second.
  ApngWriter(std::uint32_t frames, std::uint16_t fps);
  /// All frames have the size of the first. Only the rectangle that differs from the frame before is stored.
  void add(const Pixels& frame);
  /// The file, after the last frame.
  std::string finish();

 private:
  void add_control(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height);

  std::uint32_t frames_, added_ = 0, sequence_ = 0;
  std::uint16_t fps_;
  Pixels before_;
  std::string bytes_;
};

}  // namespace scanbench::render
