// Scans the rows of walls with std::from_chars.
#include "harness/scenario/wall_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/number_text.hpp"
#include "harness/files/text_file.hpp"

namespace scanbench::harness {
namespace {

constexpr std::size_t kNodesPerRow = 6;  // the row, its label and four numbers
constexpr std::size_t kMaxRowBytes = 1000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// YAML gives some bytes a meaning wherever they are: tabs, carriage returns, byte 4, other encodings.
bool is_plain_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

// Nothing but blanks, and a comment after at least one blank.
bool is_end_of_line(std::string_view text) {
  const std::size_t at = text.find_first_not_of(' ');
  return at == std::string_view::npos || (at > 0 && text[at] == '#' && is_plain_ascii(text));
}

bool is_blank_or_comment(std::string_view line) {
  const std::size_t at = line.find_first_not_of(' ');
  return at == std::string_view::npos || (line[at] == '#' && is_plain_ascii(line));
}

/// The label that a value stands for: a plain word, or one in double quotes. Nothing for other values.
std::optional<std::string_view> plain_label(std::string_view text) {
  const bool is_quoted = text.size() > 2 && text.front() == '"' && text.back() == '"';
  const std::string_view label = is_quoted ? text.substr(1, text.size() - 2) : text;
  if (label.empty() || label.size() > 64 || !is_word(label.front())) return std::nullopt;
  if (!std::ranges::all_of(label, [](char c) { return is_word(c) || c == '.' || c == '-' || c == '/'; }))
    return std::nullopt;
  if (!is_quoted && (label == "null" || label == "Null" || label == "NULL")) return std::nullopt;  // no text in YAML
  return label;
}

/// Removes the characters before `end` from the text; nothing if the text does not contain `end`.
std::optional<std::string_view> take_until(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find(end.front());
  if (at == std::string_view::npos || text.substr(at, end.size()) != end) return std::nullopt;
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at + end.size());
  return taken;
}

std::optional<double> plain_number(std::string_view text) {
  if (text.empty() || text.front() == '+') return std::nullopt;
  const std::string_view digits = text.substr(text.front() == '-' ? 1 : 0);
  // Leading zeros are an error, and words such as inf are left to the reader that names them in messages.
  if (digits.empty() || !is_digit(digits.front())) return std::nullopt;
  if (digits.size() > 1 && digits[0] == '0' && is_digit(digits[1])) return std::nullopt;
  return parse_number(text);
}

/// Removes a number and the `end` behind it from the text, if the number has at most 15 digits and no exponent; nothing
/// for other numbers, which plain_number() may read. Its digits and the power of ten are exact in a double, so that the
/// quotient is rounded once and is the nearest double (Clinger, "How to read floating point numbers accurately", PLDI
/// 1990, section 4).
std::optional<double> take_short_decimal(std::string_view& text, std::string_view end) {
  constexpr std::size_t kMaxDigits = 15;
  constexpr double kPowers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool is_negative = text.starts_with('-');
  std::size_t at = is_negative ? 1 : 0;
  const std::size_t first = at;
  std::int64_t digits = 0;
  const auto take_digits = [&] {
    const std::size_t stop = std::min(text.size(), first + kMaxDigits + 1);  // a point may be among the digits
    for (; at < stop && is_digit(text[at]); ++at) digits = 10 * digits + (text[at] - '0');
  };
  take_digits();
  const std::size_t whole = at - first;
  if (whole == 0 || whole > kMaxDigits || (whole > 1 && text[first] == '0')) return std::nullopt;
  std::size_t decimals = 0;
  if (at < text.size() && text[at] == '.') {
    const std::size_t point = at++;
    take_digits();
    decimals = at - point - 1;
    if (decimals == 0) return std::nullopt;
  }
  if (text.substr(at, end.size()) != end) return std::nullopt;
  text.remove_prefix(at + end.size());
  const double value = static_cast<double>(digits) / kPowers[decimals];
  return is_negative ? -value : value;
}

/// Appends the wall of a line without its indentation, "- [label, x1, y1, x2, y2]"; false if it has another form.
bool read_row(std::string_view row, std::vector<Wall>& walls) {
  constexpr std::string_view kBegin = "- [";
  if (!row.starts_with(kBegin)) return false;
  row.remove_prefix(kBegin.size());
  const auto first = take_until(row, ", ");
  const auto label = first ? plain_label(*first) : std::nullopt;
  if (!label) return false;
  double v[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string_view end = i < 3 ? ", " : "]";
    auto number = take_short_decimal(row, end);
    if (!number) {
      const auto text = take_until(row, end);
      number = text ? plain_number(*text) : std::nullopt;
    }
    if (!number) return false;
    v[i] = *number;
  }
  if (!is_end_of_line(row)) return false;
  walls.push_back({std::string(*label), {{v[0], v[1]}, {v[2], v[3]}}});
  return true;
}

struct KeyLine {
  std::size_t begin;   // of the line
  std::size_t indent;  // blanks before the key
};

/// The first line that consists of the key `segments:` and perhaps a comment.
std::optional<KeyLine> find_key_line(std::string_view text) {
  constexpr std::string_view kKey = "segments:";
  for (std::size_t at = text.find(kKey); at != std::string_view::npos; at = text.find(kKey, at + 1)) {
    const std::size_t before = at == 0 ? std::string_view::npos : text.find_last_not_of(' ', at - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::string_view after = text.substr(at + kKey.size());
    if ((begin == 0 || text[before] == '\n') && is_end_of_line(after.substr(0, after.find('\n'))))
      return KeyLine{begin, at - begin};
  }
  return std::nullopt;
}

std::size_t count_nodes(const YamlNode& node) {
  std::size_t count = 1;
  for (const auto& item : node.items) count += count_nodes(item);
  for (const auto& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

}  // namespace

bool WallRows::belong_to(const YamlNode& world) const {
  const auto is_at = [](const Mark& a, const Mark& b) { return a.line == b.line && a.column == b.column; };
  // A map in flow style begins with a brace, one in block style with its first key.
  if (world.kind != YamlKind::map || world.entries.empty() || !is_at(world.mark, world.entries.front().mark))
    return false;
  const auto entry = std::ranges::find(world.entries, "segments", &YamlEntry::key);
  return entry != world.entries.end() && is_at(entry->mark, key) && entry->value.kind == YamlKind::sequence &&
         entry->value.items.empty();
}

bool WallRows::fit_into(const YamlNode& root) const {
  return count_nodes(root) + kNodesPerRow * walls.size() <= kMaxYamlNodes;
}

std::optional<WallRows> take_wall_rows(std::string_view text) {
  if (text.size() > kMaxWorldBytes) return std::nullopt;
  const auto key = find_key_line(text);
  if (!key) return std::nullopt;
  std::string_view lines = text.substr(key->begin);
  lines.remove_prefix(std::min(lines.find('\n'), lines.size() - 1) + 1);
  WallRows rows;
  std::size_t indent = 0;  // of the rows; 0 before the first
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    if (line.size() > kMaxRowBytes) return std::nullopt;
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    if (!is_blank_or_comment(line)) {
      if (blanks <= key->indent) {
        if (blanks == line.size() || !is_word(line[blanks])) return std::nullopt;
        break;  // the next key
      }
      if (indent == 0) {
        indent = blanks;
        rows.walls.reserve(std::min(lines.size() / line.size() + 1, kMaxYamlNodes / kNodesPerRow));
      }
      if (blanks != indent || !read_row(line.substr(blanks), rows.walls)) return std::nullopt;
    }
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  if (rows.walls.empty()) return std::nullopt;
  rows.key = {static_cast<int>(std::ranges::count(text.substr(0, key->begin), '\n')) + 1,
              static_cast<int>(key->indent) + 1};
  rows.rest.append(text.substr(0, key->begin + key->indent)).append("segments: []\n").append(lines);
  return rows;
}

}  // namespace scanbench::harness
