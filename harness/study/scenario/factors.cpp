// Reads factors and forms all combinations of their levels.
#include "harness/study/scenario/factors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "core/number_text.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/shared_keys.hpp"

namespace scanbench::study {
namespace {

constexpr std::size_t kMostVariants = 10000;

const std::vector<io::YamlEntry>& entries_of(const io::YamlNode& node, const std::string& what,
                                             const std::string& allowed) {
  if (node.kind != io::YamlKind::map || node.entries.empty())
    throw io::PlacedError(node.mark, fmt::format("{} is {}; allowed: {}", what, io::describe_node(node), allowed));
  return node.entries;
}

std::string value_text(const io::YamlNode& value, const std::string& key) {
  if (value.kind != io::YamlKind::scalar)
    throw io::PlacedError(value.mark, fmt::format("{} is {}; allowed: one value", key, io::describe_node(value)));
  std::string text = io::write_yaml(value);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool in_section(const std::string& set, std::string_view section) {
  return set.starts_with(std::string(section) + ".");
}

/// The parts of "pipelines.0.extract" or "pipelines.0.extract=..."; an element's number becomes its name.
std::vector<std::string> path_of(const std::string& set, const ListNames& names) {
  std::vector<std::string> parts;
  std::istringstream key(set.substr(0, set.find('=')));
  for (std::string part; std::getline(key, part, '.');) parts.push_back(part);
  if (parts.size() < 2) return parts;
  const auto list = names.find(parts[0]);
  const auto index = parse_integer(parts[1]);
  const bool is_number = list != names.end() && index && *index >= 0 &&
                         static_cast<std::size_t>(*index) < list->second.size() &&
                         std::ranges::count(list->second, parts[1]) == 0;
  if (is_number) parts[1] = list->second[static_cast<std::size_t>(*index)];
  return parts;
}

/// True if one path is the other or leads to it.
bool overlap(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin());
}

std::vector<Variant> read_levels(const io::YamlEntry& factor) {
  std::vector<Variant> levels;
  for (const auto& level : entries_of(factor.value, "the factor " + factor.key, "{level: {key: value}}")) {
    require_folder_name(level.key, level.mark, "the level's name");
    levels.push_back({"-" + level.key, {}, level.mark, {{factor.key, level.key}}});
    for (const auto& entry :
         entries_of(level.value, "the level " + level.key, "{key: value}, with dotted keys like sensor.sigma_m"))
      levels.back().sets.push_back(entry.key + "=" + value_text(entry.value, entry.key));
  }
  return levels;
}

}  // namespace

std::vector<Variant> read_variants(const io::YamlNode& factors) {
  std::vector<Variant> variants{{"", {}, factors.mark}};
  for (const auto& factor : entries_of(factors, "factors", "{factor: {level: {key: value}}}")) {
    const std::vector<Variant> levels = read_levels(factor);
    if (variants.size() * levels.size() > kMostVariants)
      throw io::PlacedError(factor.mark, fmt::format("{} combinations of levels up to here; allowed: up to {}",
                                                     variants.size() * levels.size(), kMostVariants));
    std::vector<Variant> more;
    for (const Variant& variant : variants) {
      for (const Variant& level : levels) {
        more.push_back({variant.suffix + level.suffix, variant.sets, level.mark, variant.levels});
        more.back().levels.push_back(level.levels.front());
        more.back().sets.insert(more.back().sets.end(), level.sets.begin(), level.sets.end());
      }
    }
    variants = std::move(more);
  }
  return variants;
}

void refuse_sets_over_factors(const io::YamlNode& factors, const std::vector<std::string>& sets,
                              const ListNames& names) {
  for (const auto& factor : factors.entries)
    for (const auto& level : factor.value.entries)
      for (const auto& entry : level.value.entries)
        for (const auto& set : sets)
          if (overlap(path_of(set, names), path_of(entry.key, names)))
            throw io::PlacedError(
                entry.mark, fmt::format("the factor {} sets {}, and --set {} would give all of its levels one value; "
                                        "leave out --set, or the factor",
                                        factor.key, entry.key, set));
}

std::vector<std::string> sets_of_section(const std::vector<std::string>& sets, std::string_view section) {
  std::vector<std::string> chosen;
  std::ranges::copy_if(sets, std::back_inserter(chosen), [&](const auto& set) { return in_section(set, section); });
  return chosen;
}

std::vector<std::string> sets_outside_section(const std::vector<std::string>& sets, std::string_view section) {
  std::vector<std::string> others;
  std::ranges::remove_copy_if(sets, std::back_inserter(others),
                              [&](const auto& set) { return in_section(set, section); });
  return others;
}

}  // namespace scanbench::study
