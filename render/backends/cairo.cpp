// SVG and PDF backend through Cairo. Text has one symbol per glyph in SVG, below transparent text, and an embedded
// subset in PDF, so that a file looks the same if the font is not installed.
#include "render/backends/cairo.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/backends/svg_text.hpp"
#include "render/layout/layout.hpp"
#include "render/paper/font.hpp"
#include "render/paper/stroke_style.hpp"

namespace scanbench::render {
namespace {

cairo_status_t append(void* out, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

class Painter {
 public:
  Painter(cairo_t* cr, const Layout& layout) : cr_(cr), layout_(layout) {}

  void paint() {
    cairo_set_source_rgb(cr_, 1, 1, 1);
    cairo_paint(cr_);
    int clip = -1;
    cairo_save(cr_);
    for (const Shape& shape : layout_.shapes) {
      if (shape.clip != clip) {
        cairo_restore(cr_);
        cairo_save(cr_);
        clip = shape.clip;
        if (clip >= 0) {
          const Rect& box = layout_.panels[static_cast<std::size_t>(clip)].box;
          cairo_rectangle(cr_, box.x0, box.y0, box.width(), box.height());
          cairo_clip(cr_);
        }
      }
      std::visit([this](const auto& s) { paint(s); }, shape.what);
    }
    cairo_restore(cr_);
  }

 private:
  void color(const Color& c) { cairo_set_source_rgb(cr_, c.r / 255.0, c.g / 255.0, c.b / 255.0); }

  template <class S>
  void paths(const S& s, bool closed) {
    for (std::size_t k = 0; k + 1 < s.starts.size(); ++k) {
      cairo_new_sub_path(cr_);
      for (std::size_t i = s.starts[k]; i < s.starts[k + 1]; ++i) cairo_line_to(cr_, s.points[i].x(), s.points[i].y());
      if (closed) cairo_close_path(cr_);
    }
  }

  void paint(const StrokeShape& s) {
    color(s.stroke.color);
    cairo_set_line_width(cr_, s.stroke.width_pt);
    const DashPattern dash = dash_pattern(s.stroke);
    cairo_set_dash(cr_, dash.lengths.data(), dash.count, 0);
    const bool round = s.round && dash.count == 0;
    cairo_set_line_cap(cr_, round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cr_, s.round ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    paths(s, s.closed);
    cairo_stroke(cr_);
  }

  void paint(const FillShape& s) {
    color(s.color);
    cairo_set_fill_rule(cr_, s.convex ? CAIRO_FILL_RULE_WINDING : CAIRO_FILL_RULE_EVEN_ODD);
    paths(s, true);
    cairo_fill(cr_);
  }

  // A stroke without length and with round caps is a disc, in the shortest code for SVG and PDF.
  void paint(const DotsShape& s) {
    color(s.color);
    cairo_set_line_width(cr_, s.diameter);
    cairo_set_dash(cr_, nullptr, 0, 0);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    for (const Vec2& c : s.centers) {
      cairo_move_to(cr_, c.x(), c.y());
      cairo_line_to(cr_, c.x(), c.y());
    }
    cairo_stroke(cr_);
  }

  void paint(const TextShape& s) {
    const Font& font = Font::get();
    cairo_save(cr_);
    cairo_translate(cr_, s.origin.x(), s.origin.y());
    if (s.upwards) cairo_rotate(cr_, -kPi / 2);
    cairo_set_font_face(cr_, font.cairo_face());
    cairo_set_font_size(cr_, s.size);
    std::vector<cairo_glyph_t> glyphs;
    double x = 0.0;
    for (const Glyph* g : font.shape(s.text)) {
      glyphs.push_back({g->index, x, 0.0});
      x += g->advance_em * s.size;
    }
    const int n = static_cast<int>(glyphs.size());
    if (s.halo) {
      color(s.halo_color);
      cairo_set_dash(cr_, nullptr, 0, 0);
      cairo_set_line_width(cr_, 2 * kHaloPt);
      cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
      cairo_glyph_path(cr_, glyphs.data(), n);
      cairo_stroke(cr_);
    }
    color(s.color);
    cairo_show_glyphs(cr_, glyphs.data(), n);
    cairo_restore(cr_);
  }

  cairo_t* cr_;
  const Layout& layout_;
};

void draw(cairo_surface_t* made, const Layout& layout) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(made, &cairo_surface_destroy);
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), &cairo_font_options_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr(cairo_create(surface.get()), &cairo_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cr.get(), options.get());
  Painter(cr.get(), layout).paint();
  cairo_show_page(cr.get());
  cairo_surface_finish(surface.get());
  for (const cairo_status_t status : {cairo_status(cr.get()), cairo_surface_status(surface.get())})
    if (status != CAIRO_STATUS_SUCCESS) throw InternalError(std::string("Cairo: ") + cairo_status_to_string(status));
}

/// Replaces Cairo's ids by ids from the content, so that equal scenes give equal bytes and one HTML page can contain
/// several figures. Cairo numbers surfaces over the life of the process and gives the glyphs of all files the same ids.
std::string with_ids_of_content(const std::string& svg) {
  constexpr std::array<std::string_view, 4> kIntroductions{"id=\"", "href=\"#", "url(#", "url(&quot;#"};
  struct Found {
    std::size_t at;  // of the id
    std::size_t length;
    bool surface;
  };
  std::vector<Found> ids;
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a of everything but the surface's number
  for (std::size_t i = 0; i < svg.size(); ++i) {
    for (const std::string_view intro : kIntroductions) {
      if (svg.compare(i, intro.size(), intro) != 0) continue;
      const std::size_t at = i + intro.size();
      std::size_t end = at;
      while (end < svg.size() && (std::isalnum(static_cast<unsigned char>(svg[end])) != 0 || svg[end] == '-')) ++end;
      ids.push_back({at, end - at, svg.compare(at, 7, "surface") == 0});
    }
    const bool numbered =
        !ids.empty() && ids.back().surface && i >= ids.back().at && i < ids.back().at + ids.back().length;
    if (!numbered) hash = (hash ^ static_cast<unsigned char>(svg[i])) * 1099511628211U;
  }
  const std::string prefix = fmt::format("f{:08x}-", static_cast<std::uint32_t>(hash ^ hash >> 32));
  std::string out;
  out.reserve(svg.size() + ids.size() * prefix.size());
  std::size_t copied = 0;
  for (const Found& id : ids) {
    out.append(svg, copied, id.at - copied).append(prefix);
    if (id.surface)
      out.append("figure");
    else
      out.append(svg, id.at, id.length);
    copied = id.at + id.length;
  }
  return out.append(svg, copied, std::string::npos);
}

}  // namespace

std::string to_svg(const Scene& scene, std::string_view description) {
  const Layout placed = layout(scene);
  std::string svg;
  draw(cairo_svg_surface_create_for_stream(append, &svg, placed.width, placed.height), placed);
  return with_words(with_ids_of_content(svg), placed, scene.title, description);
}

std::string to_pdf(const Scene& scene) {
  const Layout placed = layout(scene);
  std::string pdf;
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append, &pdf, placed.width, placed.height);
  // A fixed date, because a figure's bytes follow from its scene alone.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, scene.title.c_str());
  draw(surface, placed);
  // Cairo 1.16 writes the date without the "D:" that PDF demands. In as many bytes, because the file counts them.
  constexpr std::string_view kWrong = "/CreationDate (20000101000000Z)", kRight = "/CreationDate (D:200001010000) ";
  static_assert(kWrong.size() == kRight.size());
  if (const auto at = pdf.find(kWrong); at != std::string::npos) pdf.replace(at, kWrong.size(), kRight);
  return pdf;
}

}  // namespace scanbench::render
