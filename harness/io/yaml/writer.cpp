// Writes YAML in its canonical form: maps in block style, lists of scalars in flow style, quotes only where needed.
#include "harness/io/yaml/writer.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/number_text.hpp"

namespace scanbench::io {
namespace {

bool is_safe_plain(std::string_view text) {
  static constexpr std::array<std::string_view, 8> kWords = {"true", "false", "null", "yes", "no", "on", "off", "y"};
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '/'; };
  if (text.empty() || !letter(text.front()) || !std::ranges::all_of(text, inner)) return false;
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower != "n" && std::ranges::find(kWords, lower) == kWords.end();
}

std::string quote(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (c == '\n')
      result += "\\n";
    else if (byte < 0x20 || byte == 0x7f)
      ((result += "\\x") += kHex[byte >> 4]) += kHex[byte & 15];
    else
      result += c;
  }
  return result + '"';
}

std::string scalar(const YamlNode& node) {
  if (node.kind == YamlKind::null) return "~";
  return node.quoted && !is_safe_plain(node.text) ? quote(node.text) : node.text;
}

std::string key_text(const std::string& key) {
  return is_safe_plain(key) ? key : quote(key);
}

bool is_scalar(const YamlNode& node) {
  return node.kind == YamlKind::scalar || node.kind == YamlKind::null;
}

// True for points, rows and named points, which are written in one line: they hold only scalars two levels down.
bool fits_flow(const YamlNode& node, int levels = 1) {
  const auto fits = [&](const YamlNode& child) {
    return is_scalar(child) || (levels > 0 && child.kind == YamlKind::sequence && fits_flow(child, 0));
  };
  return is_scalar(node) || (std::ranges::all_of(node.items, fits) &&
                             std::ranges::all_of(node.entries, [&](const YamlEntry& e) { return fits(e.value); }));
}

void write_flow(const YamlNode& node, std::string& out) {
  if (is_scalar(node)) {
    out += scalar(node);
    return;
  }
  const bool is_map = node.kind == YamlKind::map;
  out += is_map ? '{' : '[';
  bool first = true;
  const auto separate = [&] {
    if (!first) out += ", ";
    first = false;
  };
  for (const auto& item : node.items) {
    separate();
    write_flow(item, out);
  }
  for (const auto& entry : node.entries) {
    separate();
    out += key_text(entry.key) + ": ";
    write_flow(entry.value, out);
  }
  out += is_map ? '}' : ']';
}

bool in_one_line(const YamlNode& node) {
  constexpr std::size_t kLongList = 16;
  if (node.kind == YamlKind::map) return node.entries.empty();
  return fits_flow(node) && (fits_flow(node, 0) || node.items.size() <= kLongList);
}

void write_block(const YamlNode& node, int indent, std::string& out) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  for (const auto& item : node.items) {
    out += margin + "- ";
    if (in_one_line(item)) {
      write_flow(item, out);
      out += '\n';
      continue;
    }
    // The first line of the nested block continues this one.
    std::string nested;
    write_block(item, indent + 2, nested);
    out += nested.substr(static_cast<std::size_t>(indent) + 2);
  }
  for (const auto& entry : node.entries) {
    out += margin + key_text(entry.key) + ":";
    if (in_one_line(entry.value)) {
      out += ' ';
      write_flow(entry.value, out);
      out += '\n';
    } else {
      out += '\n';
      write_block(entry.value, indent + 2, out);
    }
  }
}

}  // namespace

std::string write_yaml(const YamlNode& node) {
  std::string out;
  if (in_one_line(node)) {
    write_flow(node, out);
    out += '\n';
  } else {
    write_block(node, 0, out);
  }
  return out;
}

YamlNode yaml_text(std::string text) {
  YamlNode node;
  node.kind = YamlKind::scalar;
  node.quoted = true;
  node.text = std::move(text);
  return node;
}

YamlNode yaml_plain(std::string text) {
  YamlNode node = yaml_text(std::move(text));
  node.quoted = false;
  return node;
}

YamlNode yaml_number(double value) {
  return yaml_plain(number_text(value));
}

YamlNode yaml_map() {
  YamlNode node;
  node.kind = YamlKind::map;
  return node;
}

YamlNode yaml_sequence() {
  YamlNode node;
  node.kind = YamlKind::sequence;
  return node;
}

YamlNode& yaml_add(YamlNode& map, std::string key, YamlNode value) {
  return map.entries.emplace_back(YamlEntry{std::move(key), {}, std::move(value)}).value;
}

}  // namespace scanbench::io
