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

#include "harness/files/placed_error.hpp"

namespace scanbench::harness {

enum class YamlKind { null, scalar, sequence, map };

struct YamlEntry;

struct YamlNode {
  YamlKind kind = YamlKind::null;
  bool quoted = false;  ///< of a scalar: it is text, whatever it looks like
  Mark mark;
  std::string text;                ///< of a scalar
  std::vector<YamlNode> items;     ///< of a sequence
  std::vector<YamlEntry> entries;  ///< of a map, in file order, keys unique

  /// The value of a map's key, or nullptr.
  const YamlNode* find(std::string_view key) const;
  YamlNode* find(std::string_view key);
};

struct YamlEntry {
  std::string key;
  Mark mark;  ///< of the key
  YamlNode value;
};

inline constexpr std::size_t kMaxYamlBytes = std::size_t{8} << 20;
inline constexpr int kMaxYamlDepth = 32;

/// The one document of `text`. Throws PlacedError.
YamlNode parse_yaml(std::string_view text, std::size_t max_bytes = kMaxYamlBytes);

}  // namespace scanbench::harness
