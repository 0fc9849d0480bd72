// Replaces the figures of scenarios by those that are requested, and says which of them cannot be drawn.
#include "harness/results/figures/requested_figures.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/study/catalog/find_module.hpp"

namespace scanbench::results {
namespace {

constexpr std::size_t kMostReasons = 3;

bool is_of(const FigureFile& file, const std::string& figure) {
  return file.figure == figure;
}

/// "merge_stages is not drawn: ... (and in 4 more scenarios)".
std::string reasons(const std::string& figure, const std::vector<FigureFile>& files) {
  std::vector<std::string> all;
  for (const FigureFile& file : files)
    if (is_of(file, figure) && std::ranges::count(all, file.caption) == 0) all.push_back(file.caption);
  if (all.empty()) return figure + " is not drawn: the run has no recording of the first seed";
  const std::size_t more = all.size() > kMostReasons ? all.size() - kMostReasons : 0;
  all.resize(all.size() - more);
  return join(all, "; ") + (more > 0 ? fmt::format("; and {} more reasons", more) : "");
}

}  // namespace

std::vector<study::Scenario> with_figures(std::vector<study::Scenario> scenarios,
                                          const std::vector<std::string>& names) {
  for (study::Scenario& scenario : scenarios) {
    const std::vector<study::ModuleChoice> listed = std::exchange(scenario.figures, {});
    for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
      const auto own = std::ranges::find(listed, name, &study::ModuleChoice::module);
      scenario.figures.push_back(
          own != listed.end()
              ? *own
              : study::ModuleChoice{"figure", name, resolve(study::find_module("figure", name).params, {})});
    }
  }
  return scenarios;
}

std::vector<FigureFile> beside(std::vector<FigureFile> earlier, const std::vector<FigureFile>& drawn) {
  const auto is_drawn = [&](const FigureFile& file) {
    return std::ranges::any_of(drawn, [&](const FigureFile& d) {
      return !d.name.empty() && d.scenario == file.scenario && d.figure == file.figure;
    });
  };
  std::erase_if(earlier, [&](const FigureFile& file) { return file.name.empty() && is_drawn(file); });
  for (const FigureFile& file : drawn) {
    if (file.name.empty()) continue;
    const auto same = std::ranges::find(earlier, file.name, &FigureFile::name);
    if (same != earlier.end())
      *same = file;
    else
      earlier.push_back(file);
  }
  return earlier;
}

void require_drawn(const std::vector<std::string>& names, const std::vector<FigureFile>& drawn) {
  std::string missing;
  for (const std::string& name : names)
    if (std::ranges::none_of(drawn, [&](const FigureFile& d) { return !d.name.empty() && is_of(d, name); }))
      missing += (missing.empty() ? "" : "\n") + reasons(name, drawn);
  if (!missing.empty()) throw ConfigError(missing);
}

}  // namespace scanbench::results
