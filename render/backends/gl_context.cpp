// Creates the context of software OpenGL and binds it to its buffer.
#include "render/backends/gl_context.hpp"

#include <cstdlib>

#include "core/error.hpp"

namespace scanbench::render {
namespace {

OSMesaContext create(const OsMesa& gl) {
  setenv("LP_NUM_THREADS", "0", 1);  // draw in the calling thread: workers already fill the cores
#ifdef __SANITIZE_ADDRESS__
  // Without its cache on disk Mesa starts no thread. The leak checker crashes if one ends while it looks at it.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
#endif
  OSMesaContext context = gl.create_context(OSMESA_RGBA, 0, 0, 0, nullptr);
  if (context == nullptr) throw InternalError("OSMesa: cannot create a context");
  return context;
}

}  // namespace

GlContext::GlContext() : pixels(std::size_t{4} * kSide * kSide), context_(create(gl)) {}

GlContext& GlContext::get() {
  static GlContext& context = *new GlContext;  // never freed: Mesa's own exit handlers may run before ours
  return context;
}

CurrentGl::CurrentGl() : context_(GlContext::get()), lock_(context_.mutex_) {
  constexpr int kSide = GlContext::kSide;
  if (gl().make_current(context_.context_, context_.pixels.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE)
    throw InternalError("OSMesa: cannot make the context current");
  gl().pixel_store(OSMESA_Y_UP, 0);
}

CurrentGl::~CurrentGl() {
  gl().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

void CurrentGl::view(double left, double right, double top, double bottom, int margin) const {
  gl().viewport(-margin, -margin, GlContext::kSide + 2 * margin, GlContext::kSide + 2 * margin);
  gl().matrix_mode(GL_PROJECTION);
  gl().load_identity();
  gl().ortho(left, right, bottom, top, -1, 1);
  gl().matrix_mode(GL_MODELVIEW);
  gl().load_identity();
  gl().disable(GL_DITHER);
  gl().shade_model(GL_FLAT);
  gl().disable(GL_SCISSOR_TEST);
  gl().color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl().enable_client_state(GL_VERTEX_ARRAY);
  gl().enable_client_state(GL_COLOR_ARRAY);
}

}  // namespace scanbench::render
