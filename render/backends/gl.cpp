// PNG backend through OSMesa, software OpenGL without a display. Edges are smoothed by drawing each tile kOversample
// times larger and averaging: smoothed GL lines differ between thread counts, plain triangles do not.
#include "render/backends/gl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/backends/gl_context.hpp"
#include "render/backends/png.hpp"
#include "render/backends/tessellate.hpp"
#include "render/layout/layout.hpp"

namespace scanbench::render {
namespace {

constexpr int kOversample = 4;
constexpr int kBuffer = GlContext::kSide;
constexpr int kTile = kBuffer / kOversample;  // pixels of the picture
constexpr int kMostPixels = 20000;

/// A square piece of the picture: its first pixel, its size, and the triangles that may show on it, in drawing order.
struct Tile {
  int x, y, width, height;
  std::vector<TriangleBatch> batches{};
};

/// False only if the tile is wholly beyond the triangle's box or beyond one of its edges.
bool may_meet(const Vertex* t, const Rect& tile) {
  const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
  if (x1 < tile.x0 || x0 > tile.x1 || y1 < tile.y0 || y0 > tile.y1) return false;
  for (int i = 0; i < 3; ++i) {
    const Vertex &a = t[i], &b = t[(i + 1) % 3], &c = t[(i + 2) % 3];
    const double nx = a.y - b.y, ny = b.x - a.x;
    const double side = nx * (c.x - a.x) + ny * (c.y - a.y);  // of the third corner
    const double flip = side < 0 ? -1.0 : 1.0;
    // The tile's corner that is farthest on the triangle's side of the edge.
    const double x = flip * nx > 0 ? tile.x1 : tile.x0, y = flip * ny > 0 ? tile.y1 : tile.y0;
    if (flip * (nx * (x - a.x) + ny * (y - a.y)) < 0) return false;
  }
  return true;
}

/// True for four pixels of the buffer, summed over four rows, that are white and opaque.
bool is_white(const std::uint16_t* sums) {
  std::array<std::uint64_t, 4> words{};
  std::memcpy(words.data(), sums, sizeof words);
  constexpr std::uint64_t kWhiteSums = 0x03FC03FC03FC03FCU;  // 4 * 255 in each channel
  return ((words[0] ^ kWhiteSums) | (words[1] ^ kWhiteSums) | (words[2] ^ kWhiteSums) | (words[3] ^ kWhiteSums)) == 0;
}

class Picture {
 public:
  Picture(const Layout& layout, double dpi)
      : layout_(layout),
        scale_(dpi / 72.0),
        width_(std::max(1, static_cast<int>(std::lround(layout.width * scale_)))),
        height_(std::max(1, static_cast<int>(std::lround(layout.height * scale_)))),
        columns_((width_ + kTile - 1) / kTile),
        pixels_(std::size_t{3} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 255) {
    for (int y = 0; y < height_; y += kTile)
      for (int x = 0; x < width_; x += kTile)
        tiles_.push_back(
            {.x = x, .y = y, .width = std::min(kTile, width_ - x), .height = std::min(kTile, height_ - y)});
  }

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint8_t>& rgb() const { return pixels_; }

  void draw() {
    for (const TriangleBatch& batch : tessellate(layout_.shapes, scale_ * kOversample)) sort_in(batch);
    const CurrentGl current;
    for (const Tile& tile : tiles_) {
      if (tile.batches.empty()) continue;  // remains white
      draw(tile, current);
      filter_down(current.pixels(), tile);
    }
  }

 private:
  Rect paper(const Tile& tile) const {
    return {tile.x / scale_, tile.y / scale_, (tile.x + kTile) / scale_, (tile.y + kTile) / scale_};
  }

  /// Adds each triangle to the tiles on which it may show.
  void sort_in(const TriangleBatch& batch) {
    Rect clip{0, 0, layout_.width, layout_.height};
    if (batch.clip >= 0) clip = layout_.panels[static_cast<std::size_t>(batch.clip)].box;
    const double size = kTile / scale_;
    for (std::size_t i = 0; i + 2 < batch.vertices.size(); i += 3) {
      const Vertex* t = &batch.vertices[i];
      const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
      const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
      if (x1 < clip.x0 || x0 > clip.x1 || y1 < clip.y0 || y0 > clip.y1) continue;
      const auto index = [size](double v, double low, double high) {
        return static_cast<int>(std::clamp(v, low, high) / size);
      };
      const int last_column = std::min(index(x1, clip.x0, clip.x1), columns_ - 1);
      const int last_row = std::min(index(y1, clip.y0, clip.y1), static_cast<int>(tiles_.size()) / columns_ - 1);
      for (int row = index(y0, clip.y0, clip.y1); row <= last_row; ++row)
        for (int column = index(x0, clip.x0, clip.x1); column <= last_column; ++column) {
          Tile& tile = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(column)];
          if (!may_meet(t, paper(tile))) continue;
          if (tile.batches.empty() || tile.batches.back().clip != batch.clip)
            tile.batches.push_back({.clip = batch.clip});
          auto& vertices = tile.batches.back().vertices;
          vertices.insert(vertices.end(), t, t + 3);
        }
    }
  }

  void draw(const Tile& tile, const CurrentGl& current) const {
    const Rect r = paper(tile);
    current.view(r.x0, r.x1, r.y0, r.y1);
    const OsMesa& gl = current.gl();
    gl.clear_color(1, 1, 1, 1);
    gl.clear(GL_COLOR_BUFFER_BIT);
    gl.enable(GL_SCISSOR_TEST);
    for (const TriangleBatch& batch : tile.batches) {
      if (!scissor(tile, batch.clip, gl)) continue;
      gl.vertex_pointer(2, GL_FLOAT, sizeof(Vertex), &batch.vertices[0].x);
      gl.color_pointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &batch.vertices[0].r);
      gl.draw_arrays(GL_TRIANGLES, 0, static_cast<GLsizei>(batch.vertices.size()));
    }
    gl.finish();
  }

  /// Keeps drawing inside a panel's box; false if none of it is on the tile.
  bool scissor(const Tile& tile, int clip, const OsMesa& gl) const {
    if (clip < 0) {
      gl.scissor(0, 0, kBuffer, kBuffer);
      return true;
    }
    const Rect& box = layout_.panels[static_cast<std::size_t>(clip)].box;
    const auto sub = [&](double pt, int origin) {
      return std::clamp(static_cast<int>(std::lround((pt * scale_ - origin) * kOversample)), 0, kBuffer);
    };
    const int x0 = sub(box.x0, tile.x), x1 = sub(box.x1, tile.x), y0 = sub(box.y0, tile.y), y1 = sub(box.y1, tile.y);
    if (x1 <= x0 || y1 <= y0) return false;
    gl.scissor(x0, kBuffer - y1, x1 - x0, y1 - y0);
    return true;
  }

  /// Averages blocks of kOversample^2 pixels of the buffer.
  void filter_down(const std::vector<std::uint8_t>& buffer, const Tile& tile) {
    static_assert(kOversample == 4, "four rows and four columns are added");
    constexpr std::size_t kRow = std::size_t{4} * kBuffer;
    std::array<std::uint16_t, kRow> sums{};
    for (int y = 0; y < tile.height; ++y) {
      const std::uint8_t* in = &buffer[static_cast<std::size_t>(y) * kOversample * kRow];
      for (std::size_t i = 0; i < kRow; ++i)
        sums[i] = static_cast<std::uint16_t>(in[i] + in[i + kRow] + in[i + 2 * kRow] + in[i + 3 * kRow]);
      std::uint8_t* out = &pixels_[3 * (static_cast<std::size_t>(tile.y + y) * static_cast<std::size_t>(width_) +
                                        static_cast<std::size_t>(tile.x))];
      for (std::size_t x = 0; x < static_cast<std::size_t>(tile.width); ++x) {
        const std::uint16_t* s = &sums[16 * x];
        if (is_white(s)) continue;  // as the picture begins
        for (std::size_t c = 0; c < 3; ++c)
          out[3 * x + c] = static_cast<std::uint8_t>((s[c] + s[c + 4] + s[c + 8] + s[c + 12] + 8) / 16);
      }
    }
  }

  const Layout& layout_;
  double scale_;  // pixels per point
  int width_, height_, columns_;
  std::vector<std::uint8_t> pixels_;
  std::vector<Tile> tiles_;
};

}  // namespace

Pixels to_pixels(const Scene& scene, double dpi) {
  const Layout placed = layout(scene);
  const double side = std::max(placed.width, placed.height) / 72.0 * dpi;
  if (!(dpi > 0) || !(side <= kMostPixels))
    throw ConfigError(
        fmt::format("a picture of {:.1f} x {:.1f} in at {} dpi is too large; allowed: up to {} pixels per side",
                    placed.width / 72, placed.height / 72, dpi, kMostPixels));
  Picture picture(placed, dpi);
  picture.draw();
  return {picture.width(), picture.height(), picture.rgb()};
}

std::string to_png(const Scene& scene, double dpi) {
  const Pixels pixels = to_pixels(scene, dpi);
  return encode_png(pixels.rgb, pixels.width, pixels.height, dpi);
}

}  // namespace scanbench::render
