// Reads --only and --set from the command line in the manifest.
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

/// What stands after an option, as the command line takes it: one or more words each time.
std::vector<std::string> words_after(const std::string& option, const std::vector<std::string>& argv) {
  std::vector<std::string> words;
  bool in_option = false;
  for (const std::string& word : argv) {
    if (word.starts_with('-')) {
      in_option = word == option || word.starts_with(option + "=");
      if (in_option && word != option) words.push_back(word.substr(option.size() + 1));
    } else if (in_option) {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace

bool was_selected(const runs::Manifest& manifest, const runs::CellKey& key) {
  std::vector<std::string> only;
  for (const auto& list : words_after("--only", manifest.argv)) add_names(list, only);
  if (only.empty()) return true;
  for (const auto& name : only)
    if (name == key.scenario || name == key.pipeline || name == key.scenario + "/" + key.pipeline) return true;
  return false;
}

std::vector<std::string> overrides_of(const runs::Manifest& manifest) {
  return words_after("--set", manifest.argv);
}

}  // namespace scanbench::results
