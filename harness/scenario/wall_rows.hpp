// Reads the list `segments` of a world without a YAML parser: in large worlds it is most of the file.
//
// Only the form that the project itself writes is read, one wall per line:
//
//   segments:
//     - [label, x1, y1, x2, y2]   # with a comment or without
//
// Labels consist of letters, digits, '_', '.', '-' and '/', with or without double quotes. Values are separated by a
// comma and one blank. Blank lines and lines of comments may be between rows. A list in any other form is left to the
// YAML parser.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/truth.hpp"
#include "harness/yaml/gate.hpp"

namespace scanbench::harness {

struct WallRows {
  std::vector<Wall> walls;  ///< in the file's unit; not checked for lengths and for equal labels
  std::string rest;         ///< the text with an empty list instead of the rows
  Mark key;                 ///< place of the key `segments`, in the text and in `rest`

  /// Whether the rows are the segments of `world`, a node of the tree of `rest`: it is a map in block style that has
  /// the key at its place. It is not if the key is part of a quoted text, a comment or another map.
  bool belong_to(const YamlNode& world) const;

  /// Whether parse_yaml() accepts as many nodes as `root`, the tree of `rest`, has with the rows.
  bool fit_into(const YamlNode& root) const;
};

/// Takes the rows of the first list `segments` out of the text. Returns nothing if there is no such list, if it is
/// empty, or if any of its lines has another form.
std::optional<WallRows> take_wall_rows(std::string_view text);

}  // namespace scanbench::harness
