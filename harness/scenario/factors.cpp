// Reads factors and forms all combinations of their levels.
#include "harness/scenario/factors.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/files/placed_error.hpp"
#include "harness/scenario/shared_keys.hpp"
#include "harness/yaml/writer.hpp"

namespace scanbench::harness {
namespace {

constexpr std::size_t kMostVariants = 10000;

const std::vector<YamlEntry>& entries_of(const YamlNode& node, const std::string& what, const std::string& allowed) {
  if (node.kind != YamlKind::map || node.entries.empty())
    throw PlacedError(node.mark, fmt::format("{} is {}; allowed: {}", what, describe_node(node), allowed));
  return node.entries;
}

std::string value_text(const YamlNode& value, const std::string& key) {
  if (value.kind != YamlKind::scalar)
    throw PlacedError(value.mark, fmt::format("{} is {}; allowed: one value", key, describe_node(value)));
  std::string text = write_yaml(value);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool in_section(const std::string& set, std::string_view section) {
  return set.starts_with(std::string(section) + ".");
}

std::vector<Variant> read_levels(const YamlEntry& factor) {
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

std::vector<Variant> read_variants(const YamlNode& factors) {
  std::vector<Variant> variants{{"", {}, factors.mark}};
  for (const auto& factor : entries_of(factors, "factors", "{factor: {level: {key: value}}}")) {
    const std::vector<Variant> levels = read_levels(factor);
    if (variants.size() * levels.size() > kMostVariants)
      throw PlacedError(factor.mark, fmt::format("{} combinations of levels up to here; allowed: up to {}",
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

}  // namespace scanbench::harness
