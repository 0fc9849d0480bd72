// Reads --only from the command line in the manifest.
#include "harness/results/analysis/selection.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::results {
namespace {

void add_names(std::string_view list, std::vector<std::string>& names) {
  for (std::size_t start = 0; start <= list.size();) {
    const std::size_t comma = std::min(list.find(',', start), list.size());
    names.emplace_back(list.substr(start, comma - start));
    start = comma + 1;
  }
}

/// The names after --only, as the command line takes them: one or more words, each a list with commas.
std::vector<std::string> only_names(const std::vector<std::string>& argv) {
  constexpr std::string_view kOption = "--only";
  std::vector<std::string> names;
  bool in_option = false;
  for (const std::string_view word : argv) {
    if (word.starts_with('-')) {
      in_option = word == kOption;
      if (word.starts_with("--only=")) {
        add_names(word.substr(kOption.size() + 1), names);
        in_option = true;
      }
    } else if (in_option) {
      add_names(word, names);
    }
  }
  return names;
}

}  // namespace

bool was_selected(const runs::Manifest& manifest, const runs::CellKey& key) {
  const std::vector<std::string> only = only_names(manifest.argv);
  if (only.empty()) return true;
  for (const auto& name : only)
    if (name == key.scenario || name == key.pipeline || name == key.scenario + "/" + key.pipeline) return true;
  return false;
}

}  // namespace scanbench::results
