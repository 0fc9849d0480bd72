// Typed reading of YAML trees. A key that no reader requests is refused, every value is checked against a ParamSpec,
// and every error names line and column.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "harness/io/yaml/gate.hpp"

namespace scanbench::io {

/// A map that is being read. The keys requested from it are its known keys; done() refuses all others.
class YamlMap {
 public:
  /// `what` names the map in messages: "the scenario", "sensor", "params of iepf". Throws PlacedError if the node is
  /// not a map.
  YamlMap(const YamlNode& node, std::string what);

  const std::string& what() const { return what_; }
  Mark mark() const { return node_->mark; }

  /// The key's value, or nullptr. The key counts as known afterwards.
  const YamlNode* find(std::string_view key);
  /// The key's value; throws PlacedError, with `allowed`, if it is missing.
  const YamlNode& require(std::string_view key, std::string_view allowed);
  /// Text of a required key.
  std::string text(std::string_view key, std::string_view allowed);
  std::string text_or(std::string_view key, std::string fallback);

  /// The values of the keys that `specs` name, checked against their types and bounds. Missing keys are absent.
  ParamSet params(const std::vector<ParamSpec>& specs);

  /// Throws PlacedError for the first key that was not requested. The message lists the known keys and the nearest one.
  void done() const;

 private:
  const YamlNode* node_;
  std::string what_;
  std::vector<std::string> known_;
};

/// Converts a value to the type of the spec. Throws PlacedError. Accepted forms: boolean: true, false; integer, number:
/// plain decimal (no .nan, .inf, hex, leading zeros, underscores; nothing in quotes); text: in quotes, or plain if it
/// cannot be taken for a number or a boolean, or a list of such words, which are joined with ", "; lists: [1, 2]; rows:
/// [[1, 2], [3, 4]]; named points: {A: [1, 2]}.
ParamValue read_param(const YamlNode& node, const ParamSpec& spec);

/// A scalar's text, quoted or plain, numbers included (a wall's label may be 1). Throws PlacedError.
const std::string& read_word(const YamlNode& node, std::string_view name, std::string_view allowed);

/// A finite number; `name` and `unit` are for the message. Worlds have many numbers: this is faster than read_param().
double read_number(const YamlNode& node, std::string_view name, std::string_view unit = "");

/// Describes a node in messages: "empty", "a list", "'010' (leading zeros, which some read as octal)".
std::string describe_node(const YamlNode& node);

/// Throws PlacedError unless the node is a list.
const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view name, std::string_view allowed);

/// Converts a value to a node that read_param() reads back.
YamlNode to_yaml(const ParamValue& value);
YamlNode to_yaml(const ParamSet& params);

}  // namespace scanbench::io
