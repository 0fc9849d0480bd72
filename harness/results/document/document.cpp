// Builds parts of documents, and writes documents as Markdown and for a terminal.
#include "harness/results/document/document.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

std::string markdown_safe(const std::string& text) {
  return markdown_escaped(plain_text(text));
}

/// The text inside the brackets of a link or picture: brackets of its own would end it.
std::string bracketed(const std::string& text) {
  std::string out;
  const std::string safe = markdown_safe(text);
  bool escaped = false;
  for (const char c : safe) {
    if ((c == '[' || c == ']') && !escaped) out += '\\';
    out += c;
    escaped = c == '\\' && !escaped;
  }
  return out;
}

/// An address without the characters that would end it.
std::string markdown_address(const std::string& address) {
  std::string out;
  for (const char c : address) {
    const auto byte = static_cast<unsigned char>(c);
    const bool ends = byte <= 0x20 || byte == 0x7F || std::string_view("()<>\\").find(c) != std::string_view::npos;
    out += ends ? fmt::format("%{:02X}", byte) : std::string(1, c);
  }
  return out;
}

std::string markdown_link(const std::string& text, const std::string& address) {
  return fmt::format("[{}]({})", bracketed(text), markdown_address(address));
}

std::string markdown_of(const TextSpan& span) {
  if (span.look == TextSpan::Look::code) return "`" + plain_line(span.text) + "`";
  if (span.look == TextSpan::Look::bold || span.address.starts_with('#')) return "**" + markdown_safe(span.text) + "**";
  return span.address.empty() ? markdown_safe(span.text) : markdown_link(span.text, span.address);
}

/// "seed 3", "seeds 1 to 5", "seeds 1, 3, 9", "40 seeds, 1 to 99"; empty without seeds.
std::string seeds_words(std::vector<std::uint64_t> seeds) {
  constexpr std::size_t kMostListed = 5;
  std::ranges::sort(seeds);
  seeds.erase(std::ranges::unique(seeds).begin(), seeds.end());
  if (seeds.empty()) return "";
  if (seeds.size() == 1) return fmt::format("seed {}", seeds.front());
  if (seeds.back() - seeds.front() + 1 == seeds.size())
    return fmt::format("seeds {} to {}", seeds.front(), seeds.back());
  if (seeds.size() <= kMostListed) return fmt::format("seeds {}", fmt::join(seeds, ", "));
  return fmt::format("{} seeds, {} to {}", seeds.size(), seeds.front(), seeds.back());
}

/// "2026-11-24T10:12:33Z" as "2026-11-24 10:12 UTC"; another text as it is.
std::string minute_of(const std::string& utc) {
  if (utc.size() < 16 || utc[10] != 'T' || !utc.ends_with('Z')) return utc;
  return utc.substr(0, 10) + " " + utc.substr(11, 5) + " UTC";
}

/// "0.1.0, commit 0123...-dirty-4567..." with twelve digits of the commit.
std::string version_words(const std::string& version) {
  constexpr std::string_view kCommit = ", commit ";
  constexpr std::size_t kDigits = 12;
  const std::size_t at = version.find(kCommit);
  if (at == std::string::npos) return "scanbench " + version;
  const std::string commit = version.substr(at + kCommit.size());
  return fmt::format("scanbench {}{}{}{}", version.substr(0, at), kCommit, commit.substr(0, kDigits),
                     commit.find("-dirty-") == std::string::npos ? "" : " with changes");
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
    return (shown ? "!" + markdown_link(picture.alt, picture.address) + "\n\n" : "") + line(picture.caption);
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

std::string stamp_of(const std::vector<std::pair<std::string, std::string>>& facts,
                     const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : facts) {
    if (name == "version") parts.push_back(version_words(value));
    if (name == "started") parts.insert(parts.begin(), minute_of(value));
  }
  if (std::string words = seeds_words(seeds); !words.empty()) parts.push_back(std::move(words));
  return fmt::format("{}", fmt::join(parts, " · "));
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
  if (!document.lead.spans.empty()) blocks.push_back(Paragraph{document.lead});
  if (!document.stamp.empty()) blocks.push_back(Paragraph{document.stamp});
  add_blocks(blocks, document.blocks);
  return to_markdown(blocks);
}

std::string to_terminal(const Document& document, bool color, std::size_t width) {
  return TextWriter(TextWriter::Terminal{color, width}).text(document.blocks);
}

}  // namespace scanbench::results
