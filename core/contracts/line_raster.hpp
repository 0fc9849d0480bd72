// The port through which metrics draw lines as pixels. Metrics and render may not include each other: render registers
// the implementation, a metric asks the registry for it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench {

/// A pixel of a raster without borders, centred at (x, y) times the size of a pixel.
struct Pixel {
  std::int32_t y = 0;
  std::int32_t x = 0;
  auto operator<=>(const Pixel&) const = default;  ///< by row, then by column
};

/// Draws sets of segments one pixel wide. A segment sets one pixel per column that it touches (per row if it is steeper
/// than 45 degrees): the one whose centre is nearest to its line at the middle of the column. Ends are rounded to
/// 1/256 pixel. A segment without length sets the pixel that contains it; one that is not finite sets none. Registered
/// in Registry<LineRaster>.
class LineRaster {
 public:
  static constexpr std::string_view kKind = "raster";
  static constexpr std::string_view kDefault = "osmesa";
  /// The most pixels that the segments of one call may set, those set twice counted twice: 1000 km at 1 cm.
  static constexpr double kMostPixels = 1e8;
  /// The largest row or column: 40 km at 1 cm. A row of the picture then takes 64 MB.
  static constexpr double kLastPixel = 4e6;

  virtual ~LineRaster() = default;
  /// Loads the library that draws, so that processes forked from this one have it. Starts no thread. Throws ConfigError
  /// if it is not installed.
  virtual void load() const = 0;
  /// Per layer its pixels, each once, in order. `pixel_m` > 0. The same layers give the same pixels in every thread and
  /// process. Throws ConfigError if there are more than kMostPixels pixels, if a segment reaches beyond kLastPixel, or
  /// if the library that draws is not installed.
  virtual std::vector<std::vector<Pixel>> draw(std::span<const std::vector<Segment>> layers, double pixel_m) const = 0;
};

}  // namespace scanbench
