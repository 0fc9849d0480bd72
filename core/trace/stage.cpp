// Names of stages, in the order of the enumerators.
#include "core/trace/stage.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace scanbench {
namespace {

constexpr auto kNames = std::to_array<std::string_view>({"pre", "segment", "search", "fit", "merge", "post", "match",
                                                         "split", "phase1", "phase2", "one_by_one", "joint", "resample",
                                                         "simulate", "judge", "start", "iterate", "walls"});
static_assert(kNames.size() == static_cast<std::size_t>(Stage::walls) + 1);

}  // namespace

std::span<const std::string_view> stage_names() {
  return kNames;
}

std::string_view to_string(Stage stage) {
  return kNames.at(static_cast<std::size_t>(stage));
}

std::optional<Stage> stage_named(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Stage>(found - kNames.begin());
}

}  // namespace scanbench
