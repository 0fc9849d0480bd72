// OSMesa, software OpenGL without a display, loaded when the first picture is drawn, because it loads LLVM too: 90 MB
// that most runs of the program never use.
#pragma once

#include <GL/gl.h>
#include <GL/osmesa.h>

namespace scanbench::render {

/// The functions that draw pictures, under the names of OpenGL without their prefix.
struct OsMesa {
  /// Loads the library; it stays loaded until the process ends. Throws ConfigError, which names the package to install,
  /// if the library is missing or lacks a function.
  explicit OsMesa(const char* library = "libOSMesa.so.8");

  decltype(&OSMesaCreateContextExt) create_context = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaPixelStore) pixel_store = nullptr;
  decltype(&glClear) clear = nullptr;
  decltype(&glClearColor) clear_color = nullptr;
  decltype(&glColorMask) color_mask = nullptr;
  decltype(&glColorPointer) color_pointer = nullptr;
  decltype(&glDisable) disable = nullptr;
  decltype(&glDrawArrays) draw_arrays = nullptr;
  decltype(&glEnable) enable = nullptr;
  decltype(&glEnableClientState) enable_client_state = nullptr;
  decltype(&glFinish) finish = nullptr;
  decltype(&glLoadIdentity) load_identity = nullptr;
  decltype(&glMatrixMode) matrix_mode = nullptr;
  decltype(&glOrtho) ortho = nullptr;
  decltype(&glScissor) scissor = nullptr;
  decltype(&glShadeModel) shade_model = nullptr;
  decltype(&glVertexPointer) vertex_pointer = nullptr;
  decltype(&glViewport) viewport = nullptr;
};

}  // namespace scanbench::render
