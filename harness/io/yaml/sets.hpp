// Overrides of the form key=value, applied to a YAML tree before it is read.
#pragma once

#include <string>
#include <vector>

#include "harness/io/yaml/gate.hpp"

namespace scanbench::io {

/// Applies "key=value" overrides to a tree before it is read: dotted keys; elements of a list by number or by their
/// `name`. The value is YAML. Missing maps are added; their reader then accepts or refuses the key.
/// Nodes get the mark (0, index of the override). Throws PlacedError for a path that cannot be followed.
void apply_sets(YamlNode& root, const std::vector<std::string>& sets);

}  // namespace scanbench::io
