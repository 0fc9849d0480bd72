// Parses YAML into a tree of maps, lists and scalars, and refuses everything else with line and column.
//
// yaml-cpp 0.7 accepts duplicate keys (the last one wins), ignores merge keys, follows aliases until a file of 300
// bytes takes seconds or crashes, and loads only the first of several documents. This parser reads yaml-cpp's
// events and refuses anchors, aliases, merge keys, tags, duplicate keys, keys that are not plain words, nesting deeper
// than 32 levels, several documents, and files with too many bytes, nodes or keys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/io/files/placed_error.hpp"

namespace scanbench::io {

enum class YamlKind { null, scalar, sequence, map };

struct YamlEntry;

struct YamlNode {
  YamlKind kind = YamlKind::null;
  bool quoted = false;  ///< of a scalar: it is text, even if it looks like a number
  Mark mark;
  std::string text;                ///< of a scalar
  std::vector<YamlNode> items;     ///< of a sequence
  std::vector<YamlEntry> entries;  ///< of a map, in file order, keys unique

  // Defined once, in gate.cpp: inline they cost seconds in every unit that has one.
  YamlNode();
  YamlNode(const YamlNode&);
  YamlNode(YamlNode&&) noexcept;
  YamlNode& operator=(const YamlNode&);
  YamlNode& operator=(YamlNode&&) noexcept;
  ~YamlNode();

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
inline constexpr std::size_t kMaxYamlKeys = 100000;    ///< of one map
inline constexpr std::size_t kMaxYamlNodes = 2000000;  ///< of a file: about 200 MB

/// The one document of `text`. Throws PlacedError.
YamlNode parse_yaml(std::string_view text, std::size_t max_bytes = kMaxYamlBytes);

}  // namespace scanbench::io
