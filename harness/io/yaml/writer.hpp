// Writes YAML trees as text in one canonical form: equal trees give equal bytes.
#pragma once

#include <string>

#include "harness/io/yaml/gate.hpp"

namespace scanbench::io {

/// The node as YAML text that parse_yaml() reads back to an equal tree: maps in block style, lists of scalars in flow
/// style, text in quotes where it needs them. Ends with a line break.
std::string write_yaml(const YamlNode& node);

// Constructors of nodes.
YamlNode yaml_text(std::string text);  ///< quoted when written if it could be taken for something else
YamlNode yaml_number(double value);
YamlNode yaml_plain(std::string text);  ///< a scalar written without quotes: true, false, a whole number
YamlNode yaml_map();
YamlNode yaml_sequence();
/// Appends an entry to a map and returns its value.
YamlNode& yaml_add(YamlNode& map, std::string key, YamlNode value);

}  // namespace scanbench::io
