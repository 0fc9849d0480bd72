// Applies `--set key=value` overrides to the tree before it is checked.
#include "harness/io/yaml/sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/names.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"

namespace scanbench::io {
namespace {

void mark_all(YamlNode& node, Mark mark) {
  node.mark = mark;
  for (auto& item : node.items) mark_all(item, mark);
  for (auto& entry : node.entries) {
    entry.mark = mark;
    mark_all(entry.value, mark);
  }
}

// The name by which an override selects an element of a list: a map's `name`, or a scalar's text.
std::string element_name(const YamlNode& item) {
  if (item.kind == YamlKind::scalar) return item.text;
  const YamlNode* name = item.find("name");
  return name != nullptr && name->kind == YamlKind::scalar ? name->text : "";
}

YamlNode& element(YamlNode& list, const std::string& key, const std::string& path, Mark mark) {
  for (auto& item : list.items)
    if (element_name(item) == key) return item;
  const auto index = parse_integer(key);
  if (index && *index >= 0 && static_cast<std::size_t>(*index) < list.items.size())
    return list.items[static_cast<std::size_t>(*index)];
  std::vector<std::string> names;
  for (const auto& item : list.items) names.push_back(element_name(item));
  throw PlacedError(mark, fmt::format("{} has no element {}{} (or by number, 0 .. {})", path, quoted_excerpt(key),
                                      known_names(key, names), list.items.size() - (list.items.empty() ? 0U : 1U)));
}

YamlNode& child(YamlNode& node, const std::string& key, const std::string& path, Mark mark) {
  if (node.kind == YamlKind::sequence) return element(node, key, path, mark);
  if (node.kind == YamlKind::null) node.kind = YamlKind::map;
  if (node.kind != YamlKind::map)
    throw PlacedError(mark, fmt::format("{} is {}, which has no keys", path, describe_node(node)));
  if (YamlNode* value = node.find(key)) return *value;
  node.entries.push_back({key, mark, {}});
  node.entries.back().value.mark = mark;
  return node.entries.back().value;
}

}  // namespace

void apply_sets(YamlNode& root, const std::vector<std::string>& sets) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Mark mark{0, static_cast<int>(i)};
    const std::size_t equals = sets[i].find('=');
    if (equals == std::string::npos || equals == 0)
      throw PlacedError(mark, "not an override; allowed: key=value, like limits.seconds=60");
    YamlNode value;
    try {
      value = parse_yaml(std::string_view(sets[i]).substr(equals + 1));
    } catch (const PlacedError& error) {
      throw PlacedError(mark, error.what());
    }
    mark_all(value, mark);

    YamlNode* node = &root;
    std::string path;
    std::string_view rest = std::string_view(sets[i]).substr(0, equals);
    while (true) {
      const std::size_t dot = rest.find('.');
      const std::string key(rest.substr(0, dot));
      if (key.empty()) throw PlacedError(mark, "a part of the key is empty; allowed: names with single dots between");
      node = &child(*node, key, path.empty() ? "the file" : path, mark);
      path += (path.empty() ? "" : ".") + key;
      if (dot == std::string_view::npos) break;
      rest.remove_prefix(dot + 1);
    }
    *node = std::move(value);
  }
}

}  // namespace scanbench::io
