// The gate in front of every YAML file: a tree of plain nodes, or a refusal with the place.
//
// yaml-cpp 0.7 accepts duplicate keys (the last one wins), ignores merge keys, follows aliases until a file of 300
// bytes takes seconds or crashes, and loads the first of several documents without a word. The gate listens to its
// parser's events and refuses all of that: anchors, aliases, merge keys, tags, duplicate keys, keys that are not plain
// words, nesting deeper than 32, several documents, too large files. What is left is a tree of maps, lists and scalars.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace scanbench::harness {

/// 1-based. Line 0 marks a node that no file holds: it came from a `--set` override, and column is its 0-based number.
struct YamlMark {
  int line = 0;
  int column = 0;
};

enum class YamlKind { null, scalar, sequence, map };

struct YamlEntry;

struct YamlNode {
  YamlKind kind = YamlKind::null;
  bool quoted = false;  ///< of a scalar: it is text, whatever it looks like
  YamlMark mark;
  std::string text;                ///< of a scalar
  std::vector<YamlNode> items;     ///< of a sequence
  std::vector<YamlEntry> entries;  ///< of a map, in file order, keys unique

  /// The value of a map's key, or nullptr.
  const YamlNode* find(std::string_view key) const;
  YamlNode* find(std::string_view key);
};

struct YamlEntry {
  std::string key;
  YamlMark mark;  ///< of the key
  YamlNode value;
};

/// An error inside a file whose name only the caller knows; in_file() turns it into a ConfigError.
class PlacedError : public ConfigError {
 public:
  PlacedError(YamlMark mark, const std::string& message) : ConfigError(message), mark_(mark) {}
  YamlMark mark() const { return mark_; }

 private:
  YamlMark mark_;
};

inline constexpr std::size_t kMaxYamlBytes = std::size_t{8} << 20;
inline constexpr std::size_t kMaxWorldBytes = std::size_t{64} << 20;
inline constexpr int kMaxYamlDepth = 32;

/// The one document of `text`. Throws PlacedError.
YamlNode parse_yaml(std::string_view text, std::size_t max_bytes = kMaxYamlBytes);

/// Throws the error as a ConfigError with `file:line:col: ` in front, or `--set key=value: ` for an override.
[[noreturn]] void rethrow_in_file(const PlacedError& error, const std::string& file,
                                  const std::vector<std::string>& sets);

/// Runs `work` and puts the file's name in front of its PlacedErrors.
template <class Work>
auto in_file(const std::string& file, const std::vector<std::string>& sets, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const PlacedError& error) {
    rethrow_in_file(error, file, sets);
  }
}

/// The node as YAML text that parse_yaml() reads back to an equal tree: maps in block style, lists of scalars in flow
/// style, text in quotes where it needs them. Ends with a line break.
std::string write_yaml(const YamlNode& node);

// Making trees to write.
YamlNode yaml_text(std::string text);  ///< quoted when written if it could be taken for something else
YamlNode yaml_number(double value);
YamlNode yaml_plain(std::string text);  ///< a scalar as it stands: true, false, a whole number
YamlNode yaml_map();
YamlNode yaml_sequence();
/// Appends an entry to a map and returns its value.
YamlNode& yaml_add(YamlNode& map, std::string key, YamlNode value);

}  // namespace scanbench::harness
