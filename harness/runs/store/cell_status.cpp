// Converts the status of a cell to its name and back.
#include "harness/runs/store/cell_status.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"

namespace scanbench::runs {
namespace {

constexpr std::string_view kStatusNames[] = {"ok",      "skipped", "invalid",      "failed",
                                             "crashed", "timeout", "out_of_memory"};

}  // namespace

std::string_view to_string(CellStatus status) {
  return kStatusNames[static_cast<std::size_t>(status)];
}

CellStatus cell_status_from(std::string_view name) {
  const auto found = std::ranges::find(kStatusNames, name);
  if (found == std::end(kStatusNames))
    throw ConfigError("unknown status '" + std::string(name) +
                      "'; allowed: ok, skipped, invalid, failed, crashed, timeout, out_of_memory");
  return static_cast<CellStatus>(found - std::begin(kStatusNames));
}

}  // namespace scanbench::runs
