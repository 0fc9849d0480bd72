// Scene -> PNG through OSMesa, software OpenGL without a display. Anti-aliased by drawing each tile kOversample times
// larger and averaging: smoothed GL lines differ between thread counts, plain triangles do not.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/png.hpp"
#include "render/tessellate.hpp"

namespace scanbench::render {
namespace {

constexpr int kOversample = 4;
constexpr int kTile = 512;  // of the picture; its buffer of (4 * 512)^2 pixels takes 16 MiB
constexpr int kBuffer = kTile * kOversample;

/// The process' one context: the first costs 20 ms. Used under its mutex, current in one thread at a time.
class Context {
 public:
  static Context& get() {
    static Context& context = *new Context;  // never freed: Mesa's own exit handlers may run before ours
    return context;
  }

  std::mutex mutex;

  void make_current() {
    if (OSMesaMakeCurrent(context_, pixels.data(), GL_UNSIGNED_BYTE, kBuffer, kBuffer) != GL_TRUE)
      throw InternalError("OSMesa: cannot make the context current");
    OSMesaPixelStore(OSMESA_Y_UP, 0);
  }
  void release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  std::vector<std::uint8_t> pixels;  // rows from top to bottom, RGBA

 private:
  Context() : pixels(std::size_t{4} * kBuffer * kBuffer) {
    setenv("LP_NUM_THREADS", "0", 1);  // draw in the calling thread: workers already fill the cores
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 0, 8, 0, nullptr);
    if (context_ == nullptr) throw InternalError("OSMesa: cannot create a context with a stencil buffer");
  }
  OSMesaContext context_ = nullptr;
};

struct Current {
  explicit Current(Context& c) : context(c), lock(c.mutex) { context.make_current(); }
  ~Current() { context.release(); }
  Context& context;
  std::lock_guard<std::mutex> lock;
};

/// A tile of the picture: its first pixel and its size.
struct Tile {
  int x, y, width, height;
};

class TileDrawer {
 public:
  TileDrawer(const Layout& layout, const Tile& tile, double px_per_pt)
      : layout_(layout), tile_(tile), scale_(px_per_pt) {
    paper_ = {tile.x / scale_, tile.y / scale_, (tile.x + kTile) / scale_, (tile.y + kTile) / scale_};
  }

  void draw(const std::vector<TriangleBatch>& batches) {
    glViewport(0, 0, kBuffer, kBuffer);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(paper_.x0, paper_.x1, paper_.y1, paper_.y0, -1, 1);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DITHER);
    glShadeModel(GL_FLAT);
    glEnable(GL_SCISSOR_TEST);
    scissor({tile_.x / scale_, tile_.y / scale_, (tile_.x + tile_.width) / scale_, (tile_.y + tile_.height) / scale_});
    glClearColor(1, 1, 1, 1);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    for (const TriangleBatch& batch : batches) draw(batch);
    glDisable(GL_SCISSOR_TEST);
    glFinish();
  }

 private:
  /// Keeps drawing inside a rectangle on paper; false if none of it lies on the tile.
  bool scissor(const Rect& r) {
    const auto sub = [&](double pt, int origin) {
      return std::clamp(static_cast<int>(std::lround((pt * scale_ - origin) * kOversample)), 0, kBuffer);
    };
    const int x0 = sub(r.x0, tile_.x), x1 = sub(r.x1, tile_.x), y0 = sub(r.y0, tile_.y), y1 = sub(r.y1, tile_.y);
    if (x1 <= x0 || y1 <= y0) return false;
    glScissor(x0, kBuffer - y1, x1 - x0, y1 - y0);
    return true;
  }

  void draw(const TriangleBatch& batch) {
    const Rect clip = batch.clip < 0 ? Rect{0, 0, layout_.width, layout_.height}
                                     : layout_.panels[static_cast<std::size_t>(batch.clip)].box;
    if (!scissor(clip)) return;
    const bool plain = batch.rule == TriangleBatch::Rule::plain;
    if (plain) {
      visible_.clear();
      for (std::size_t i = 0; i + 2 < batch.vertices.size(); i += 3)
        if (on_tile(&batch.vertices[i], 3)) visible_.insert(visible_.end(), &batch.vertices[i], &batch.vertices[i] + 3);
      submit(visible_);
    } else if (!batch.vertices.empty() && on_tile(batch.vertices.data(), batch.vertices.size())) {
      fill(batch);
    }
  }

  bool on_tile(const Vertex* v, std::size_t count) const {
    float x0 = v->x, x1 = v->x, y0 = v->y, y1 = v->y;
    for (std::size_t i = 1; i < count; ++i) {
      x0 = std::min(x0, v[i].x), x1 = std::max(x1, v[i].x);
      y0 = std::min(y0, v[i].y), y1 = std::max(y1, v[i].y);
    }
    return x1 >= paper_.x0 && x0 <= paper_.x1 && y1 >= paper_.y0 && y0 <= paper_.y1;
  }

  static void submit(const std::vector<Vertex>& vertices) {
    if (vertices.empty()) return;
    glVertexPointer(2, GL_FLOAT, sizeof(Vertex), &vertices[0].x);
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &vertices[0].r);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  }

  /// Stencil, then cover: fans count the winding of each pixel, a rectangle over them is drawn where it counts as
  /// inside.
  void fill(const TriangleBatch& batch) {
    glEnable(GL_STENCIL_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    if (batch.rule == TriangleBatch::Rule::even_odd) {
      glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
    } else {
      glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
      glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
    }
    submit(batch.vertices);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_NOTEQUAL, 0, ~0u);
    glStencilOp(GL_ZERO, GL_ZERO, GL_ZERO);
    Vertex low = batch.vertices[0], high = low;
    for (const Vertex& v : batch.vertices) {
      low.x = std::min(low.x, v.x), low.y = std::min(low.y, v.y);
      high.x = std::max(high.x, v.x), high.y = std::max(high.y, v.y);
    }
    Vertex right = low, below = low;
    right.x = high.x, below.y = high.y;
    submit({low, right, below, below, right, high});
    glDisable(GL_STENCIL_TEST);
  }

  const Layout& layout_;
  Tile tile_;
  double scale_;
  Rect paper_;
  std::vector<Vertex> visible_;
};

/// Averages blocks of kOversample^2 pixels of the buffer into the picture (BGR).
void filter_down(const std::vector<std::uint8_t>& buffer, const Tile& tile, int picture_width,
                 std::vector<std::uint8_t>& picture) {
  const std::size_t row = std::size_t{4} * kBuffer,
                    used = std::size_t{4} * kOversample * static_cast<std::size_t>(tile.width);
  std::vector<std::uint16_t> sums(used);
  for (int y = 0; y < tile.height; ++y) {
    const std::uint8_t* in = &buffer[static_cast<std::size_t>(y) * kOversample * row];
    for (std::size_t i = 0; i < used; ++i)
      sums[i] = static_cast<std::uint16_t>(in[i] + in[i + row] + in[i + 2 * row] + in[i + 3 * row]);
    std::uint8_t* out = &picture[3 * (static_cast<std::size_t>(tile.y + y) * static_cast<std::size_t>(picture_width) +
                                      static_cast<std::size_t>(tile.x))];
    for (std::size_t x = 0; x < static_cast<std::size_t>(tile.width); ++x) {
      const std::uint16_t* s = &sums[16 * x];
      for (std::size_t c = 0; c < 3; ++c)
        out[3 * x + 2 - c] = static_cast<std::uint8_t>((s[c] + s[c + 4] + s[c + 8] + s[c + 12] + 8) / 16);
    }
  }
}

}  // namespace

std::string to_png(const Scene& scene, double dpi) {
  static_assert(kOversample == 4, "filter_down() adds four rows and four columns");
  const Layout placed = layout(scene);
  const double scale = dpi / 72.0;
  if (!(dpi > 0) || !(placed.width * scale < 20000) || !(placed.height * scale < 20000))
    throw ConfigError(
        fmt::format("a picture of {:.1f} x {:.1f} in at {} dpi is not possible: up to 20000 pixels a side",
                    placed.width / 72, placed.height / 72, dpi));
  const int width = std::max(1, static_cast<int>(std::lround(placed.width * scale)));
  const int height = std::max(1, static_cast<int>(std::lround(placed.height * scale)));
  const std::vector<TriangleBatch> batches = tessellate(placed.shapes, scale * kOversample);
  std::vector<std::uint8_t> picture(std::size_t{3} * static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
  {
    const Current current(Context::get());
    for (int y = 0; y < height; y += kTile)
      for (int x = 0; x < width; x += kTile) {
        const Tile tile{x, y, std::min(kTile, width - x), std::min(kTile, height - y)};
        TileDrawer(placed, tile, scale).draw(batches);
        filter_down(current.context.pixels, tile, width, picture);
      }
  }
  return encode_png(picture, width, height, dpi);
}

}  // namespace scanbench::render
