// Loads OSMesa and fills its function table.
#include "render/backends/osmesa.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace scanbench::render {
namespace {

std::string last_error() {
  const char* message = dlerror();
  return message == nullptr ? "unknown error" : message;
}

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr)
    throw ConfigError("PNG figures need OSMesa with the function " + std::string(name) + ": " + last_error());
}

}  // namespace

OsMesa::OsMesa(const char* library) {
  // Another rasterizer draws other bytes. Mesa reads the variable when the first context is made.
  ::unsetenv("GALLIUM_DRIVER");
  // Never closed: Mesa registers exit handlers, which must still exist at the end of the process.
  void* handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw ConfigError("PNG figures need OSMesa: install libosmesa6 (" + last_error() + ")");
  find(handle, "OSMesaCreateContextExt", create_context);
  find(handle, "OSMesaMakeCurrent", make_current);
  find(handle, "OSMesaPixelStore", pixel_store);
  find(handle, "glClear", clear);
  find(handle, "glClearColor", clear_color);
  find(handle, "glColorMask", color_mask);
  find(handle, "glColorPointer", color_pointer);
  find(handle, "glDisable", disable);
  find(handle, "glDrawArrays", draw_arrays);
  find(handle, "glEnable", enable);
  find(handle, "glEnableClientState", enable_client_state);
  find(handle, "glFinish", finish);
  find(handle, "glLoadIdentity", load_identity);
  find(handle, "glMatrixMode", matrix_mode);
  find(handle, "glOrtho", ortho);
  find(handle, "glScissor", scissor);
  find(handle, "glShadeModel", shade_model);
  find(handle, "glVertexPointer", vertex_pointer);
  find(handle, "glViewport", viewport);
}

}  // namespace scanbench::render
