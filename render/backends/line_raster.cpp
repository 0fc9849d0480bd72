// Lines as pixels, drawn tile by tile with the software OpenGL that draws the figures. The edges of a parallelogram
// that is one pixel high contain the centre of exactly one pixel per column, so triangles give thin lines. OpenGL's own
// lines would leave out pixels at their ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/contracts/line_raster.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "render/backends/gl_context.hpp"

namespace scanbench::render {
namespace {

constexpr int kRasterTile = GlContext::kSide;
// A piece of a line as wide as a tile is less than two tiles high. With this margin about the tile OpenGL cuts none of
// them, which would give its corners other roundings. The whole is a power of two, so coordinates remain exact.
constexpr int kMargin = 3 * kRasterTile / 2;
constexpr std::size_t kLayersAtOnce = 3;  // red, green and blue

struct Corner {
  float x, y;
  std::uint8_t r = 255, g = 255, b = 255, a = 255;
};

/// Triangles of each layer, in pixels from the tile's corner.
using TileTriangles = std::array<std::vector<Corner>, kLayersAtOnce>;

/// Tiles by row, then by column.
using Tiles = std::map<std::pair<int, int>, TileTriangles>;

int tile_of(double pixel) {
  return static_cast<int>(std::floor(pixel / kRasterTile));
}

/// A segment in pixels, with its major axis along u: v changes by at most one pixel per column of u.
struct Thin {
  double u0, v0, slope;
  int first, last;  ///< columns that it touches
  bool steep;       ///< u is y

  Thin(Vec2 a, Vec2 b) : steep(std::abs(b.y() - a.y()) > std::abs(b.x() - a.x())) {
    if (steep) std::swap(a.x(), a.y()), std::swap(b.x(), b.y());
    if (a.x() > b.x()) std::swap(a, b);
    u0 = a.x(), v0 = a.y();
    slope = b.x() > a.x() ? (b.y() - a.y()) / (b.x() - a.x()) : 0.0;
    first = static_cast<int>(std::floor(a.x() + 0.5));
    last = static_cast<int>(std::floor(b.x() + 0.5));
  }
  double v(double u) const { return v0 + (u - u0) * slope; }
};

/// The quadrilateral over the columns first .. last, one pixel high, in the coordinates of a tile. Centres of pixels
/// are whole numbers in `line` and halves in OpenGL. Corners are multiples of 1/256, which OpenGL keeps: tiles that
/// share the quadrilateral agree on its pixels.
void add_piece(const Thin& line, int first, int last, int tile_u, int tile_v, std::vector<Corner>& triangles) {
  const auto corner = [&](double u, double lift) {
    const auto along = static_cast<float>(u + 0.5 - static_cast<double>(tile_u) * kRasterTile);
    const double v = std::round(256.0 * line.v(u)) / 256.0;
    const auto across = static_cast<float>(v + lift - static_cast<double>(tile_v) * kRasterTile);
    return line.steep ? Corner{across, along} : Corner{along, across};
  };
  const double left = first - 0.5, right = last + 0.5;
  const Corner a = corner(left, 0), b = corner(right, 0), c = corner(right, 1), d = corner(left, 1);
  triangles.insert(triangles.end(), {a, b, c, a, c, d});
}

/// Cuts the line at the columns where tiles begin. All tiles that a piece touches draw it.
void add_line(const Thin& line, std::size_t layer, Tiles& tiles) {
  for (int tile_u = tile_of(line.first); tile_u <= tile_of(line.last); ++tile_u) {
    const int first = std::max(line.first, tile_u * kRasterTile),
              last = std::min(line.last, tile_u * kRasterTile + kRasterTile - 1);
    const auto [low, high] = std::minmax({line.v(first - 0.5), line.v(last + 0.5)});
    for (int tile_v = tile_of(low + 0.49); tile_v <= tile_of(high + 0.51); ++tile_v) {
      const std::pair key = line.steep ? std::pair(tile_u, tile_v) : std::pair(tile_v, tile_u);
      add_piece(line, first, last, tile_u, tile_v, tiles[key][layer]);
    }
  }
}

void draw(const TileTriangles& triangles, const CurrentGl& current) {
  current.view(-kMargin, kRasterTile + kMargin, -kMargin, kRasterTile + kMargin, kMargin);
  const OsMesa& gl = current.gl();
  gl.clear_color(0, 0, 0, 0);
  gl.clear(GL_COLOR_BUFFER_BIT);
  for (std::size_t layer = 0; layer < triangles.size(); ++layer) {
    const std::vector<Corner>& corners = triangles[layer];
    if (corners.empty()) continue;
    const auto only = [layer](std::size_t channel) -> GLboolean { return layer == channel ? GL_TRUE : GL_FALSE; };
    gl.color_mask(only(0), only(1), only(2), GL_FALSE);
    gl.vertex_pointer(2, GL_FLOAT, sizeof(Corner), &corners[0].x);
    gl.color_pointer(4, GL_UNSIGNED_BYTE, sizeof(Corner), &corners[0].r);
    gl.draw_arrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
  }
  gl.finish();
}

/// The columns of the set pixels of one row of tiles, per layer and row.
using BandRows = std::array<std::array<std::vector<std::int32_t>, kRasterTile>, kLayersAtOnce>;

void collect(const std::vector<std::uint8_t>& buffer, int first_column, BandRows& rows) {
  for (std::size_t y = 0; y < as_index(kRasterTile); ++y) {
    const std::uint8_t* row = &buffer[4 * as_index(kRasterTile) * y];
    for (std::size_t x = 0; x < as_index(kRasterTile); x += 4) {
      std::array<std::uint64_t, 2> four{};  // most pixels are not set
      std::memcpy(four.data(), row + 4 * x, sizeof four);
      if ((four[0] | four[1]) == 0) continue;
      for (std::size_t i = x; i < x + 4; ++i)
        for (std::size_t layer = 0; layer < kLayersAtOnce; ++layer)
          if (row[4 * i + layer] != 0) rows[layer][y].push_back(first_column + static_cast<std::int32_t>(i));
    }
  }
}

class OsmesaRaster : public LineRaster {
 public:
  using Params = NoParams;
  explicit OsmesaRaster(const Params&) {}

  /// A context is not made: Mesa then starts a thread, and a process that forks must have one alone.
  void load() const override { OsMesa(); }

  std::vector<std::vector<Pixel>> draw(std::span<const std::vector<Segment>> layers, double pixel_m) const override {
    check(layers, pixel_m);
    std::vector<std::vector<Pixel>> pixels(layers.size());
    for (std::size_t begin = 0; begin < layers.size(); begin += kLayersAtOnce) {
      const std::size_t count = std::min(kLayersAtOnce, layers.size() - begin);
      draw_some(layers.subspan(begin, count), pixel_m, std::span(pixels).subspan(begin, count));
    }
    return pixels;
  }

 private:
  static bool finite(const Segment& s) { return s.a.allFinite() && s.b.allFinite(); }

  static void check(std::span<const std::vector<Segment>> layers, double pixel_m) {
    SCANBENCH_ASSERT(pixel_m > 0);
    double drawn = 0.0, farthest = 0.0;
    for (const auto& layer : layers)
      for (const Segment& s : layer) {
        if (!finite(s)) continue;
        drawn += 1.0 + (s.b - s.a).cwiseAbs().maxCoeff() / pixel_m;
        farthest = std::max({farthest, s.a.cwiseAbs().maxCoeff(), s.b.cwiseAbs().maxCoeff()});
      }
    if (!(drawn <= kMostPixels))
      throw ConfigError(fmt::format("lines of {:.4g} pixels of {} m; allowed: up to {:.0f}; larger pixels need fewer",
                                    drawn, pixel_m, kMostPixels));
    if (!(farthest / pixel_m < kLastPixel))
      throw ConfigError(
          fmt::format("a line {:.4g} m from the origin, with pixels of {} m; allowed: up to {:.0f} pixels", farthest,
                      pixel_m, kLastPixel));
  }

  static void draw_some(std::span<const std::vector<Segment>> layers, double pixel_m,
                        std::span<std::vector<Pixel>> pixels) {
    Tiles tiles;
    for (std::size_t layer = 0; layer < layers.size(); ++layer)
      for (const Segment& s : layers[layer])
        if (finite(s)) add_line(Thin(s.a / pixel_m, s.b / pixel_m), layer, tiles);
    if (tiles.empty()) return;
    const CurrentGl current;
    BandRows rows;
    for (auto tile = tiles.begin(); tile != tiles.end(); ++tile) {
      const auto [row, column] = tile->first;
      render::draw(tile->second, current);
      collect(current.pixels(), column * kRasterTile, rows);
      if (const auto next = std::next(tile); next != tiles.end() && next->first.first == row) continue;
      for (std::size_t layer = 0; layer < layers.size(); ++layer)
        for (std::size_t y = 0; y < as_index(kRasterTile); ++y) {
          for (const std::int32_t x : rows[layer][y])
            pixels[layer].push_back({.y = row * kRasterTile + static_cast<std::int32_t>(y), .x = x});
          rows[layer][y].clear();
        }
    }
  }
};

SCANBENCH_REGISTER(LineRaster, OsmesaRaster,
                   {.name = std::string(LineRaster::kDefault),
                    .summary = "lines one pixel wide, by OSMesa",
                    .reference = ""});

}  // namespace
}  // namespace scanbench::render
