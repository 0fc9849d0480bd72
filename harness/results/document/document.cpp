// Builds parts of documents, and writes documents as Markdown and for a terminal.
#include "harness/results/document/document.hpp"

#include <optional>

#include <fmt/format.h>

#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

std::string markdown_safe(const std::string& text) {
  return markdown_escaped(plain_text(text));
}

std::string markdown_of(const TextSpan& span) {
  if (span.look == TextSpan::Look::code) return "`" + plain_line(span.text) + "`";
  if (span.look == TextSpan::Look::bold || span.address.starts_with('#')) return "**" + markdown_safe(span.text) + "**";
  return span.address.empty() ? markdown_safe(span.text)
                              : fmt::format("[{}]({})", markdown_safe(span.text), span.address);
}

/// Writes blocks as lines of Markdown, or of plain text for a terminal.
class TextWriter {
 public:
  struct Terminal {
    bool color;
    std::size_t width;
  };
  explicit TextWriter(std::optional<Terminal> terminal) : terminal_(terminal) {}

  std::string text(const Blocks& blocks) const {
    std::string out;
    for (const Block& block : blocks) {
      const std::string more = std::visit(*this, static_cast<const AnyBlock&>(block));
      // On a terminal a list is directly below the line that introduces it.
      const bool joins = terminal_ && std::holds_alternative<BulletList>(block);
      if (!out.empty() && !more.empty() && !joins) out += "\n";
      out += more;
    }
    return out;
  }

  std::string operator()(const Heading& heading) const {
    const auto level = static_cast<std::size_t>(heading.level);
    return (terminal_ ? "" : std::string(level, '#') + " ") + line(heading.text);
  }
  std::string operator()(const Paragraph& paragraph) const { return line(paragraph.text); }
  std::string operator()(const BulletList& list) const {
    std::string out;
    for (const Prose& item : list.items) out += item_mark() + line(item);
    return out;
  }
  std::string operator()(const Definitions& definitions) const {
    std::string out;
    for (const auto& [name, meaning] : definitions.items) out += item_mark() + line({name, ": ", meaning});
    return out;
  }
  std::string operator()(const Table& table) const {
    return terminal_ ? to_terminal(table, terminal_->color, terminal_->width) : to_markdown(table);
  }
  std::string operator()(const Picture& picture) const {
    const bool shown = !terminal_ && !picture.address.empty();
    return (shown ? fmt::format("![{}]({})\n\n", markdown_safe(picture.alt), picture.address) : "") +
           line(picture.caption);
  }
  std::string operator()(const ContentLinks&) const { return ""; }
  std::string operator()(const Markup&) const { return ""; }
  std::string operator()(const Fold& fold) const { return line(fold.summary + ":") + "\n" + text(fold.blocks); }
  std::string operator()(const BlockGroup& group) const { return text(group.blocks); }

 private:
  std::string item_mark() const { return terminal_ ? "  " : "- "; }

  std::string line(const Prose& prose) const {
    std::string out;
    for (const TextSpan& span : prose.spans) out += terminal_ ? plain_text(span.text) : markdown_of(span);
    return out + "\n";
  }

  std::optional<Terminal> terminal_;  ///< none: Markdown
};

}  // namespace

TextSpan link(std::string text, std::string address, std::string hint) {
  TextSpan span(std::move(text));
  span.address = std::move(address);
  span.hint = std::move(hint);
  return span;
}

void add_blocks(Blocks& blocks, Blocks more) {
  for (Block& block : more) blocks.push_back(std::move(block));
}

Blocks fact_blocks(const std::vector<std::pair<std::string, std::string>>& facts) {
  return {Heading{2, "How to get these numbers again", "facts"}, Definitions{facts}};
}

ContentLinks contents_of(const Blocks& blocks) {
  ContentLinks links;
  for (const Block& block : blocks)
    if (const auto* heading = std::get_if<Heading>(&block); heading != nullptr && !heading->id.empty())
      links.places.emplace_back(heading->id, heading->text.spans.front().text);
  return links;
}

Blocks section_blocks(std::vector<Section> sections, const std::vector<std::pair<std::string, std::string>>& facts) {
  Blocks blocks;
  for (Section& section : sections) {
    if (section.blocks.empty()) continue;
    blocks.push_back(Heading{2, section.title, section.id});
    add_blocks(blocks, std::move(section.blocks));
  }
  add_blocks(blocks, fact_blocks(facts));
  blocks.insert(blocks.begin(), contents_of(blocks));
  return blocks;
}

std::string to_markdown(const Blocks& blocks) {
  return TextWriter({}).text(blocks);
}

std::string to_markdown(const Document& document) {
  Blocks blocks;
  if (!document.title.empty()) blocks.push_back(Heading{1, document.title});
  add_blocks(blocks, document.blocks);
  return to_markdown(blocks);
}

std::string to_terminal(const Document& document, bool color, std::size_t width) {
  return TextWriter(TextWriter::Terminal{color, width}).text(document.blocks);
}

}  // namespace scanbench::results
