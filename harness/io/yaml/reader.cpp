// Turns YAML nodes into checked values.
#include "harness/io/yaml/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/writer.hpp"

namespace scanbench::io {
namespace {

// Some YAML readers take 010 for 8, others for 10.
bool has_leading_zero(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return text.size() > 1 && text[0] == '0' && text[1] >= '0' && text[1] <= '9';
}

ParamValue scalar_value(const YamlNode& node) {
  if (node.quoted) return node.text;
  if (node.text == "true") return true;
  if (node.text == "false") return false;
  if (has_leading_zero(node.text)) return node.text;
  if (const auto whole = parse_integer(node.text)) return static_cast<std::int64_t>(*whole);
  if (const auto number = parse_number(node.text)) return *number;
  return node.text;
}

[[noreturn]] void refuse(const YamlNode& node, std::string_view name, std::string_view allowed) {
  throw PlacedError(node.mark, fmt::format("{} is {}; allowed: {}", name, describe_node(node), allowed));
}

bool is_numeric(const ParamSpec& spec) {
  return spec.type == ParamType::integer || spec.type == ParamType::number;
}

ParamValue read_scalar(const YamlNode& node, const ParamSpec& spec) {
  if (node.kind != YamlKind::scalar) refuse(node, spec.name, allowed_text(spec));
  const ParamValue value = scalar_value(node);
  const bool is_text = std::holds_alternative<std::string>(value);
  if (is_text && (is_numeric(spec) || spec.type == ParamType::boolean)) refuse(node, spec.name, allowed_text(spec));
  if (!is_text && spec.type == ParamType::text)
    refuse(node, spec.name, "text, in quotes if it looks like a number or a boolean");
  try {
    return checked(spec, value);
  } catch (const ParamError& error) {
    throw PlacedError(node.mark, error.what());
  }
}

// One number of a list, under the list's bounds.
double read_element(const YamlNode& node, const ParamSpec& list, const std::string& position) {
  ParamSpec spec;
  spec.name = list.name + position;
  spec.bounds = list.bounds;
  spec.unit = list.unit;
  return std::get<double>(read_scalar(node, spec));
}

std::vector<double> read_numbers(const YamlNode& node, const ParamSpec& spec, const std::string& position) {
  if (node.kind != YamlKind::sequence) refuse(node, spec.name + position, "a list of numbers, [1, 2]");
  std::vector<double> numbers;
  numbers.reserve(node.items.size());
  for (std::size_t i = 0; i < node.items.size(); ++i)
    numbers.push_back(read_element(node.items[i], spec, position + fmt::format("[{}]", i)));
  return numbers;
}

NamedPoints read_points(const YamlNode& node, const ParamSpec& spec) {
  if (node.kind != YamlKind::map) refuse(node, spec.name, allowed_text(spec));
  NamedPoints points;
  for (const auto& entry : node.entries) {
    const std::vector<double> xy = read_numbers(entry.value, spec, "." + entry.key);
    if (xy.size() != 2)
      throw PlacedError(entry.value.mark,
                        fmt::format("{}.{} has {} numbers; allowed: 2, [x, y]", spec.name, entry.key, xy.size()));
    points.emplace_back(entry.key, Vec2(xy[0], xy[1]));
  }
  return points;
}

std::string joined_words(const YamlNode& node, const ParamSpec& spec) {
  std::string text;
  for (const auto& item : node.items)
    text += (text.empty() ? "" : ", ") + std::get<std::string>(read_scalar(item, spec));
  return text;
}

}  // namespace

std::string describe_node(const YamlNode& node) {
  switch (node.kind) {
    case YamlKind::null:
      return "empty";
    case YamlKind::sequence:
      return "a list";
    case YamlKind::map:
      return "a map";
    case YamlKind::scalar:
      break;
  }
  if (node.quoted) return "the text \"" + std::string(node.text.substr(0, 40)) + "\"";
  const bool zero = has_leading_zero(node.text) && parse_number(node.text);
  return quoted_excerpt(node.text) + (zero ? " (leading zeros, which some read as octal)" : "");
}

YamlMap::YamlMap(const YamlNode& node, std::string what) : node_(&node), what_(std::move(what)) {
  if (node.kind != YamlKind::map) refuse(node, what_, "a map, key: value");
}

const YamlNode* YamlMap::find(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return node_->find(key);
}

const YamlNode& YamlMap::require(std::string_view key, std::string_view allowed) {
  const YamlNode* value = find(key);
  if (value == nullptr) {
    // A misspelt key is the likelier cause: the message then names the place of that key.
    for (const auto& entry : node_->entries)
      if (std::ranges::find(known_, entry.key) == known_.end() && nearest_name(entry.key, {std::string(key)}) == key)
        throw PlacedError(
            entry.mark, fmt::format("unknown key {} in {}; did you mean '{}'?", quoted_excerpt(entry.key), what_, key));
    throw PlacedError(node_->mark, fmt::format("{} has no '{}'; allowed: {}", what_, key, allowed));
  }
  return *value;
}

std::string YamlMap::text(std::string_view key, std::string_view allowed) {
  const YamlNode& node = require(key, allowed);
  if (node.kind != YamlKind::scalar || !std::holds_alternative<std::string>(scalar_value(node)) || node.text.empty())
    refuse(node, key, allowed);
  return node.text;
}

std::string YamlMap::text_or(std::string_view key, std::string fallback) {
  const YamlNode* node = find(key);
  if (node == nullptr) return fallback;
  ParamSpec spec;
  spec.name = key;
  spec.type = ParamType::text;
  return std::get<std::string>(read_scalar(*node, spec));
}

ParamSet YamlMap::params(const std::vector<ParamSpec>& specs) {
  ParamSet set;
  for (const auto& spec : specs)
    if (const YamlNode* node = find(spec.name)) set.emplace(spec.name, read_param(*node, spec));
  return set;
}

void YamlMap::done() const {
  for (const auto& entry : node_->entries)
    if (std::ranges::find(known_, entry.key) == known_.end())
      throw PlacedError(entry.mark, fmt::format("unknown key {} in {}{}", quoted_excerpt(entry.key), what_,
                                                known_names(entry.key, known_)));
}

ParamValue read_param(const YamlNode& node, const ParamSpec& spec) {
  switch (spec.type) {
    case ParamType::boolean:
    case ParamType::integer:
    case ParamType::number:
    case ParamType::choice:
      return read_scalar(node, spec);
    case ParamType::text:
      return node.kind == YamlKind::sequence ? ParamValue(joined_words(node, spec)) : read_scalar(node, spec);
    case ParamType::number_list:
      return read_numbers(node, spec, "");
    case ParamType::number_rows: {
      NumberRows rows;
      for (const auto& item : read_list(node, spec.name, allowed_text(spec)))
        rows.push_back(read_numbers(item, spec, fmt::format("[{}]", rows.size())));
      return rows;
    }
    case ParamType::named_points:
      return read_points(node, spec);
  }
  throw InternalError("a parameter type without a reader");
}

const std::string& read_word(const YamlNode& node, std::string_view name, std::string_view allowed) {
  if (node.kind != YamlKind::scalar || node.text.empty()) refuse(node, name, allowed);
  return node.text;
}

double read_number(const YamlNode& node, std::string_view name, std::string_view unit) {
  if (node.kind == YamlKind::scalar && !node.quoted && !has_leading_zero(node.text))
    if (const auto number = parse_number(node.text)) return *number;
  if (node.kind == YamlKind::scalar && !node.quoted && has_leading_zero(node.text) &&
      node.text.find('.') != std::string::npos)
    refuse(node, name, "a number without leading zeros");
  refuse(node, name, fmt::format("a number{}{}", unit.empty() ? "" : " in ", unit));
}

const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view name, std::string_view allowed) {
  if (node.kind != YamlKind::sequence) refuse(node, name, allowed);
  return node.items;
}

YamlNode to_yaml(const ParamValue& value) {
  struct Visitor {
    YamlNode operator()(bool v) const { return yaml_plain(v ? "true" : "false"); }
    YamlNode operator()(std::int64_t v) const { return yaml_plain(std::to_string(v)); }
    YamlNode operator()(double v) const { return yaml_number(v); }
    YamlNode operator()(const std::string& v) const { return yaml_text(v); }
    YamlNode operator()(const std::vector<double>& v) const {
      YamlNode list = yaml_sequence();
      for (const double x : v) list.items.push_back(yaml_number(x));
      return list;
    }
    YamlNode operator()(const NumberRows& v) const {
      YamlNode list = yaml_sequence();
      for (const auto& row : v) list.items.push_back((*this)(row));
      return list;
    }
    YamlNode operator()(const NamedPoints& v) const {
      YamlNode map = yaml_map();
      for (const auto& [name, p] : v) yaml_add(map, name, (*this)(std::vector<double>{p.x(), p.y()}));
      return map;
    }
  };
  return std::visit(Visitor{}, value);
}

YamlNode to_yaml(const ParamSet& params) {
  YamlNode map = yaml_map();
  for (const auto& [name, value] : params) yaml_add(map, name, to_yaml(value));
  return map;
}

}  // namespace scanbench::io
