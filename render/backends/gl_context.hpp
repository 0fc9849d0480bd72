// The OpenGL context of the process, created when the first picture is drawn.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "render/backends/osmesa.hpp"

namespace scanbench::render {

/// The only OpenGL context of the process, because one costs 20 ms. Used under its mutex, current in one thread at a
/// time. It draws into a square buffer of kSide x kSide pixels, which stays in the cache.
class GlContext {
 public:
  static constexpr int kSide = 512;

  /// Throws ConfigError if OSMesa is not installed.
  static GlContext& get();

  const OsMesa gl;
  std::vector<std::uint8_t> pixels;  ///< rows from top to bottom, RGBA

 private:
  friend class CurrentGl;
  GlContext();

  std::mutex mutex_;
  OSMesaContext context_;
};

/// Makes the context current for its lifetime.
class CurrentGl {
 public:
  CurrentGl();
  ~CurrentGl();
  CurrentGl(const CurrentGl&) = delete;
  CurrentGl& operator=(const CurrentGl&) = delete;

  const OsMesa& gl() const { return context_.gl; }
  const std::vector<std::uint8_t>& pixels() const { return context_.pixels; }
  /// Maps the rectangle of the plane with these edges to the buffer and `margin` pixels about it; y grows downwards.
  /// Vertices without shading, colours without dithering, no scissors.
  void view(double left, double right, double top, double bottom, int margin = 0) const;

 private:
  GlContext& context_;
  std::lock_guard<std::mutex> lock_;
};

}  // namespace scanbench::render
