// Reads outlines and widths of letters with FreeType, without hinting, so that they scale: PDF, SVG and PNG have the
// same layout.
#include "render/paper/font.hpp"

#include <cairo-ft.h>
#include <ft2build.h>
#include <algorithm>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "core/error.hpp"
#include "render/paper/fill_triangles.hpp"
#include "render/paper/utf8.hpp"

namespace scanbench::render {
namespace {

std::string font_file() {
  if (const char* named = std::getenv("SCANBENCH_FONT"); named != nullptr && *named != '\0') {
    if (std::filesystem::exists(named)) return named;
    throw ConfigError("SCANBENCH_FONT names '" + std::string(named) + "', which does not exist");
  }
  for (const char* path :
       {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf"})
    if (std::filesystem::exists(path)) return path;
  throw ConfigError("figures need the font DejaVu Sans: install fonts-dejavu-core, or name the file in SCANBENCH_FONT");
}

struct Flattener {
  std::vector<std::vector<Vec2>>& contours;
  double em;
  Vec2 last = Vec2::Zero();

  Vec2 point(const FT_Vector* v) const { return {static_cast<double>(v->x) / em, static_cast<double>(v->y) / em}; }
};

// A quadratic piece of a letter is shorter than 0.5 em; six chords stay within 0.002 em of it.
constexpr int kChords = 6;

int on_move(const FT_Vector* to, void* user) {
  auto& f = *static_cast<Flattener*>(user);
  f.contours.push_back({f.last = f.point(to)});
  return 0;
}
int on_line(const FT_Vector* to, void* user) {
  auto& f = *static_cast<Flattener*>(user);
  f.contours.back().push_back(f.last = f.point(to));
  return 0;
}
int on_conic(const FT_Vector* control, const FT_Vector* to, void* user) {
  auto& f = *static_cast<Flattener*>(user);
  const Vec2 a = f.last, b = f.point(control), c = f.point(to);
  for (int i = 1; i <= kChords; ++i) {
    const double t = static_cast<double>(i) / kChords, s = 1 - t;
    f.contours.back().push_back(s * s * a + 2 * s * t * b + t * t * c);
  }
  f.last = c;
  return 0;
}
int on_cubic(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to, void* user) {
  auto& f = *static_cast<Flattener*>(user);
  const Vec2 a = f.last, b = f.point(control1), c = f.point(control2), d = f.point(to);
  for (int i = 1; i <= kChords; ++i) {
    const double t = static_cast<double>(i) / kChords, s = 1 - t;
    f.contours.back().push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
  }
  f.last = d;
  return 0;
}

}  // namespace

struct Font::Impl {
  FT_Library library = nullptr;
  FT_Face outlines = nullptr;   // ours, under the mutex
  FT_Face for_cairo = nullptr;  // Cairo locks it by itself
  cairo_font_face_t* cairo = nullptr;
  mutable std::mutex mutex;
  mutable std::map<char32_t, Glyph> glyphs;

  const Glyph& glyph(char32_t code) const {
    const auto [it, is_new] = glyphs.try_emplace(code);
    if (!is_new) return it->second;
    Glyph& g = it->second;
    g.index = FT_Get_Char_Index(outlines, code);
    if (FT_Load_Glyph(outlines, static_cast<FT_UInt>(g.index), FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING) != 0) return g;
    Flattener flattener{g.contours, static_cast<double>(outlines->units_per_EM)};
    g.advance_em = static_cast<double>(outlines->glyph->advance.x) / flattener.em;
    const FT_Outline_Funcs funcs{on_move, on_line, on_conic, on_cubic, 0, 0};
    FT_Outline_Decompose(&outlines->glyph->outline, &funcs, &flattener);
    g.triangles = fill_triangles(g.contours, false);
    return g;
  }
};

Font::~Font() = default;

Font::Font() : impl_(std::make_unique<Impl>()) {
  const std::string file = font_file();
  if (FT_Init_FreeType(&impl_->library) != 0 || FT_New_Face(impl_->library, file.c_str(), 0, &impl_->outlines) != 0 ||
      FT_New_Face(impl_->library, file.c_str(), 0, &impl_->for_cairo) != 0 || !FT_IS_SCALABLE(impl_->outlines))
    throw ConfigError("'" + file + "' is not an outline font");
  impl_->cairo = cairo_ft_font_face_create_for_ft_face(impl_->for_cairo, FT_LOAD_NO_HINTING);
  double top = 0.0;
  for (const auto& contour : impl_->glyph(U'H').contours)
    for (const Vec2& p : contour) top = std::max(top, p.y());
  if (top > 0) cap_height_em_ = top;
}

const Font& Font::get() {
  // Never freed: Cairo's cache of scaled fonts points to its face until the process ends.
  static const Font& font = *new Font;
  return font;
}

std::vector<const Glyph*> Font::shape(std::string_view text) const {
  const std::lock_guard lock(impl_->mutex);
  std::vector<const Glyph*> glyphs;
  glyphs.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) glyphs.push_back(&impl_->glyph(next_code_point(text, at)));
  return glyphs;
}

double Font::width_em(std::string_view text) const {
  double width = 0.0;
  for (const Glyph* g : shape(text)) width += g->advance_em;
  return width;
}

cairo_font_face_t* Font::cairo_face() const {
  return impl_->cairo;
}

std::string fit_text(std::string_view text, double width_em) {
  const Font& font = Font::get();
  if (font.width_em(text) <= width_em) return std::string(text);
  const std::string ellipsis = "\u2026";
  while (!text.empty() && font.width_em(text) + font.width_em(ellipsis) > width_em) {
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.remove_suffix(1);
    text.remove_suffix(1);
  }
  return std::string(text) + ellipsis;
}

namespace {

/// Every line but the last as full as it can be.
std::vector<std::string> filled_lines(std::string_view text, double width_em, int most_lines) {
  const Font& font = Font::get();
  std::vector<std::string> lines;
  while (!text.empty()) {
    if (static_cast<int>(lines.size()) + 1 >= most_lines || font.width_em(text) <= width_em) {
      lines.push_back(fit_text(text, width_em));
      return lines;
    }
    std::size_t end = text.find(' ');  // of the line; a word too long for a line is shortened
    for (std::size_t next = end; next != std::string_view::npos && font.width_em(text.substr(0, next)) <= width_em;
         next = text.find(' ', next + 1))
      end = next;
    lines.push_back(fit_text(text.substr(0, end), width_em));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

/// Whether no text was shortened.
bool holds_all(const std::vector<std::string>& lines, std::string_view text) {
  std::string joined;
  for (const auto& line : lines) joined += (joined.empty() ? "" : " ") + line;
  return joined == text;
}

}  // namespace

std::vector<std::string> wrap_text(std::string_view text, double width_em, int most_lines) {
  const std::vector<std::string> lines = filled_lines(text, width_em, most_lines);
  if (lines.size() < 2 || !holds_all(lines, text)) return lines;
  // Of about equal width, so that the last line is not a single word: the narrowest with as many lines.
  double narrow = 0.0, wide = width_em;
  std::vector<std::string> best = lines;
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (narrow + wide);
    std::vector<std::string> tried = filled_lines(text, middle, most_lines);
    const bool fits = tried.size() == lines.size() && holds_all(tried, text);
    if (fits) best = std::move(tried);
    (fits ? wide : narrow) = middle;
  }
  return best;
}

}  // namespace scanbench::render
