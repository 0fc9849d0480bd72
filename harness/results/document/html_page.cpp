// Writes documents as HTML: the frame of the page and every block.
#include "harness/results/document/html_page.hpp"

#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "harness/results/document/html_table.hpp"
#include "harness/results/document/page_assets.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

std::string html_text(const std::string& text) {
  return html_escaped(plain_text(text));
}

std::string html_line(const Prose& prose) {
  std::string out;
  for (const TextSpan& span : prose.spans) {
    std::string text = html_text(span.text);
    if (span.look != TextSpan::Look::plain)
      text = fmt::format("<{0}>{1}</{0}>", span.look == TextSpan::Look::bold ? "b" : "code", text);
    if (!span.address.empty())
      text =
          fmt::format("<a{}{}>{}</a>", html_attribute("href", span.address), html_attribute("title", span.hint), text);
    out += text;
  }
  return out;
}

struct HtmlWriter {
  std::string operator()(const Heading& heading) const {
    return fmt::format("<h{0}{1}>{2}</h{0}>\n", heading.level, html_attribute("id", heading.id),
                       html_line(heading.text));
  }
  std::string operator()(const Paragraph& paragraph) const {
    return fmt::format("<p{}>{}</p>\n", html_attribute("class", paragraph.style), html_line(paragraph.text));
  }
  std::string operator()(const BulletList& list) const {
    std::string out = "<ul>\n";
    for (const Prose& item : list.items) out += "<li>" + html_line(item) + "</li>\n";
    return out + "</ul>\n";
  }
  std::string operator()(const Definitions& definitions) const {
    std::string out = "<dl>\n";
    for (const auto& [name, meaning] : definitions.items)
      out += "<dt>" + html_text(name) + "</dt><dd>" + html_text(meaning) + "</dd>\n";
    return out + "</dl>\n";
  }
  std::string operator()(const Table& table) const { return to_html(table); }
  std::string operator()(const Picture& picture) const {
    const std::string& source = picture.data.empty() ? picture.address : picture.data;
    std::string shown = picture.drawing;
    if (shown.empty() && !source.empty())
      shown = fmt::format("<img{} alt=\"{}\" src=\"{}\">", picture.data.empty() ? " loading=\"lazy\"" : "",
                          html_text(picture.alt), html_escaped(source));
    if (shown.empty()) return (*this)(Paragraph{picture.caption, "faint"});
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", shown, html_line(picture.caption));
  }
  std::string operator()(const ContentLinks& contents) const {
    std::string out = "<nav>";
    for (const auto& [id, title] : contents.places) out += html_line({link(title, "#" + id)});
    return out + "</nav>\n";
  }
  std::string operator()(const Markup& markup) const { return markup.html; }
  std::string operator()(const Fold& fold) const {
    return fmt::format("<details><summary>{}</summary>\n{}</details>\n", html_text(fold.summary), to_html(fold.blocks));
  }
  std::string operator()(const BlockGroup& group) const {
    return fmt::format("<div{}{}>\n{}</div>\n", html_attribute("class", group.style), html_attribute("id", group.id),
                       to_html(group.blocks));
  }
};

}  // namespace

std::string to_html(const Blocks& blocks) {
  std::string out;
  for (const Block& block : blocks) out += std::visit(HtmlWriter{}, static_cast<const AnyBlock&>(block));
  return out;
}

std::string to_html(const Document& document) {
  std::string head = "<h1>" + html_text(document.title) + "</h1>\n";
  if (!document.lead.spans.empty())
    head +=
        fmt::format("<p class=\"lead{}\">{}</p>\n",
                    document.lead_style.empty() ? "" : " " + html_text(document.lead_style), html_line(document.lead));
  if (!document.stamp.empty()) head += "<p class=\"stamp\">" + html_text(document.stamp) + "</p>\n";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{} – scanbench</title><style>{}</style></head>\n<body>\n<header>\n{}</header>\n<main>\n{}</main>\n"
      "<script>{}</script></body></html>\n",
      html_text(document.title), page_style(), head, to_html(document.blocks), page_script());
}

}  // namespace scanbench::results
