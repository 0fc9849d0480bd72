// Writes <title>, <desc> and <text> elements into the text of an SVG file.
#include "render/backends/svg_text.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <variant>

#include <fmt/format.h>

#include "render/paper/font.hpp"
#include "render/paper/utf8.hpp"

namespace scanbench::render {
namespace {

void append_utf8(char32_t code, std::string& out) {
  const auto add = [&](char32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
  const auto tail = [&](int shift) { add(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0U | code >> 6), tail(0);
  } else if (code < 0x10000) {
    add(0xE0U | code >> 12), tail(6), tail(0);
  } else {
    add(0xF0U | code >> 18), tail(12), tail(6), tail(0);
  }
}

/// As XML allows it; what XML has no character for is U+FFFD.
std::string xml_text(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t code = next_code_point(text, at);
    const bool is_character = code < 0xD800 || (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code <= 0x10FFFF);
    if (code == U'&')
      out += "&amp;";
    else if (code == U'<')
      out += "&lt;";
    else if (code == U'>')
      out += "&gt;";
    else
      append_utf8(is_character ? code : char32_t{0xFFFD}, out);
  }
  return out;
}

std::string text_element(const TextShape& text) {
  const double x = text.origin.x(), y = text.origin.y();
  const std::string turned = text.upwards ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y) : "";
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" textLength=\"{:.2f}\"{}>{}</text>\n", x, y,
                     text.size, Font::get().width_em(text.text) * text.size, turned, xml_text(text.text));
}

std::string text_layer(const Layout& layout) {
  std::string layer;
  std::set<std::tuple<double, double, std::string>> written;  // a halo repeats its text
  for (const Shape& shape : layout.shapes)
    if (const auto* text = std::get_if<TextShape>(&shape.what);
        text != nullptr && written.emplace(text->origin.x(), text->origin.y(), text->text).second)
      layer += text_element(*text);
  if (layer.empty()) return layer;
  return "<g fill-opacity=\"0\" font-family=\"DejaVu Sans, sans-serif\">\n" + layer + "</g>\n";
}

}  // namespace

std::string with_words(std::string svg, const Layout& layout, std::string_view title, std::string_view description) {
  std::string head;
  if (!title.empty()) head += "<title>" + xml_text(title) + "</title>\n";
  if (!description.empty()) head += "<desc>" + xml_text(description) + "</desc>\n";
  if (const auto end = svg.rfind("</svg>"); end != std::string::npos) svg.insert(end, text_layer(layout));
  const auto root = svg.find("<svg");
  const auto after = root == std::string::npos ? root : svg.find('>', root);
  if (after != std::string::npos) svg.insert(after + 1, "\n" + head);
  return svg;
}

}  // namespace scanbench::render
