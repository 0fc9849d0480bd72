// The only font of all figures: DejaVu Sans, loaded from its file, never through the system's font choice, so that the
// bytes of a figure do not depend on the settings of the desktop.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/geometry.hpp"

extern "C" {
typedef struct _cairo_font_face cairo_font_face_t;  // NOLINT: as Cairo declares it
}

namespace scanbench::render {

/// Outline in em, y up, origin on the baseline; filled by the non-zero rule.
struct Glyph {
  unsigned long index = 0;
  double advance_em = 0.0;
  std::vector<std::vector<Vec2>> contours;  ///< closed, curves flattened
  std::vector<Vec2> triangles;              ///< of the area inside, three points each
};

class Font {
 public:
  /// Loaded at the first call, once per process; safe from any thread. Throws ConfigError if the file is missing. The
  /// environment variable SCANBENCH_FONT names another file.
  static const Font& get();

  /// Glyphs of a UTF-8 text. Malformed bytes and control characters show as a box or a replacement mark.
  std::vector<const Glyph*> shape(std::string_view text) const;
  double width_em(std::string_view text) const;
  /// Height of capitals and digits.
  double cap_height_em() const { return cap_height_em_; }

  cairo_font_face_t* cairo_face() const;

  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

 private:
  Font();
  ~Font();
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double cap_height_em_ = 0.73;
};

/// The text, shortened with an ellipsis if it is wider than `width_em`.
std::string fit_text(std::string_view text, double width_em);

/// The text in as few lines of at most `width_em` as possible, of about equal width, broken at spaces; what does not
/// fit in `most_lines` is shortened with an ellipsis. Empty without text.
std::vector<std::string> wrap_text(std::string_view text, double width_em, int most_lines);

}  // namespace scanbench::render
