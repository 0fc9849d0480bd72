// Writes and reads lists of SHA-256 as `sha256sum` does.
#include "harness/io/files/hash_list.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

#include "core/error.hpp"
#include "harness/io/files/hash.hpp"

namespace scanbench::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kHashDigits = 64;
constexpr std::string_view kGap = "  ";  // a blank, and another for a file that is read as text

struct PathEscape {
  char character;
  char letter;  ///< after the backslash
};
constexpr PathEscape kPathEscapes[] = {{'\\', '\\'}, {'\n', 'n'}, {'\r', 'r'}};

std::string escaped_path(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const auto* const escape = std::ranges::find(kPathEscapes, c, &PathEscape::character);
    if (escape == std::end(kPathEscapes))
      text += c;
    else
      (text += '\\') += escape->letter;
  }
  return text;
}

/// Returns an empty path for a text with an unknown escape.
std::string unescaped_path(std::string_view text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      path += text[i];
      continue;
    }
    const char letter = ++i < text.size() ? text[i] : '\0';
    const auto* const escape = std::ranges::find(kPathEscapes, letter, &PathEscape::letter);
    if (escape == std::end(kPathEscapes)) return "";
    path += escape->character;
  }
  return path;
}

bool is_hash(std::string_view text) {
  return text.size() == kHashDigits &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace

std::string hash_line(const std::string& path, const std::string& sha256) {
  const std::string text = escaped_path(path);
  return (text == path ? "" : "\\") + sha256 + std::string(kGap) + text + "\n";
}

std::string hash_lines(const fs::path& folder) {
  std::string lines;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && !entry.is_symlink())
      lines += hash_line(entry.path().filename().string(), sha256_of_file(entry.path()));
  return lines;
}

std::string hash_list(const FileHashes& hashes) {
  std::string text;
  for (const auto& [path, sha256] : hashes) text += hash_line(path, sha256);
  return text;
}

FileHashes parse_hash_list(std::string_view text, const std::string& file) {
  FileHashes hashes;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool has_escapes = line.starts_with('\\');
    if (has_escapes) line.remove_prefix(1);
    const std::string_view hash = line.substr(0, kHashDigits);
    const std::string_view rest = line.substr(hash.size());
    const std::string_view written = rest.substr(std::min(kGap.size(), rest.size()));
    std::string path = has_escapes ? unescaped_path(written) : std::string(written);
    if (!is_hash(hash) || !rest.starts_with(kGap) || path.empty())
      throw ConfigError(file + ":" + std::to_string(number) +
                        ": not a line of sha256sum; allowed: 64 hexadecimal digits, two blanks, a path");
    hashes.insert_or_assign(std::move(path), hash);
  }
  return hashes;
}

}  // namespace scanbench::io
