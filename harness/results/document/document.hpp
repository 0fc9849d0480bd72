// A page as a value: what it says, in order. It is built once and written as HTML, Markdown or text for a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/results/document/table.hpp"

namespace scanbench::results {

/// A piece of text with one look. The writers escape it.
struct TextSpan {
  enum class Look { plain, bold, code };

  TextSpan(std::string words, Look how = Look::plain) : text(std::move(words)), look(how) {}
  TextSpan(const char* words) : text(words) {}

  std::string text;
  Look look = Look::plain;
  std::string address{};  ///< what the text leads to: a relative address, or "#" and an id of the page; may be empty
  std::string hint{};     ///< HTML: shown when the pointer rests on the text
};

inline TextSpan bold(std::string text) {
  return {std::move(text), TextSpan::Look::bold};
}
inline TextSpan code(std::string text) {
  return {std::move(text), TextSpan::Look::code};
}
TextSpan link(std::string text, std::string address, std::string hint = "");

/// A line of text.
struct Prose {
  Prose() = default;
  Prose(std::string text) : spans{TextSpan(std::move(text))} {}
  Prose(const char* text) : spans{TextSpan(text)} {}
  Prose(std::initializer_list<TextSpan> parts) : spans(parts) {}

  std::vector<TextSpan> spans;
};

struct Heading {
  int level = 2;
  Prose text;
  std::string id{};
};

struct Paragraph {
  Prose text;
  std::string style{};  ///< HTML: its class in the style sheet
};

struct BulletList {
  std::vector<Prose> items;
};

/// Names and what they mean.
struct Definitions {
  std::vector<std::pair<std::string, std::string>> items;
};

/// A picture with its caption. Without any picture, the caption alone says why there is none.
struct Picture {
  std::string alt;
  Prose caption;
  std::string address{};  ///< relative address; the one that Markdown shows
  std::string data{};     ///< HTML: the picture itself as a data address, instead of `address`
  std::string drawing{};  ///< HTML: inline SVG, instead of both
};

/// HTML: a line of links to places of the page, id and title of each. The other writers leave it out.
struct ContentLinks {
  std::vector<std::pair<std::string, std::string>> places;
};

/// What only HTML can show: inline SVG, styles, scripts. The other writers leave it out.
struct Markup {
  std::string html;
};

struct Block;
using Blocks = std::vector<Block>;

/// A part that HTML shows on request.
struct Fold {
  std::string summary;
  Blocks blocks;
};

/// Blocks that HTML arranges together.
struct BlockGroup {
  std::string style;  ///< its class in the style sheet
  Blocks blocks;
  std::string id{};
};

using AnyBlock =
    std::variant<Heading, Paragraph, BulletList, Definitions, Table, Picture, ContentLinks, Markup, Fold, BlockGroup>;

struct Block : AnyBlock {
  using AnyBlock::AnyBlock;
};

/// Every page has the same head: the title, a sentence, and one line of when, what and from which seeds.
struct Document {
  std::string title;
  Blocks blocks;
  Prose lead{};              ///< what a reader wants to know first, in a sentence or two; may be empty
  std::string lead_style{};  ///< HTML: its class in the style sheet
  std::string stamp{};       ///< stamp_of(); may be empty
};

/// "2026-11-24 10:12 UTC · scanbench 0.1.0, commit 0123456789ab · seeds 1 to 5" from the facts "started" and "version"
/// of a run; what is not known is left out.
std::string stamp_of(const std::vector<std::pair<std::string, std::string>>& facts,
                     const std::vector<std::uint64_t>& seeds);

/// Appends `more` to `blocks`.
void add_blocks(Blocks& blocks, Blocks more);

/// Facts under the heading "How to get these numbers again".
Blocks fact_blocks(const std::vector<std::pair<std::string, std::string>>& facts);

/// A part of a page: the id of its heading, the heading, and what is below it.
struct Section {
  std::string id;
  std::string title;
  Blocks blocks;
};

/// Links to the headings of the second level, which need ids.
ContentLinks contents_of(const Blocks& blocks);

/// The sections that are not empty and fact_blocks(), with links to all of them before.
Blocks section_blocks(std::vector<Section> sections, const std::vector<std::pair<std::string, std::string>>& facts);

/// The document as Markdown. Bold replaces links to places of the page, because their ids are HTML's.
std::string to_markdown(const Document& document);
std::string to_markdown(const Blocks& blocks);

/// The document as plain text: tables as to_terminal() of a table, no more than `width` characters wide.
std::string to_terminal(const Document& document, bool color, std::size_t width = 1000);

}  // namespace scanbench::results
