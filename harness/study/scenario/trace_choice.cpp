// Looks up names of trace rows, and lists them as text.
#include "harness/study/scenario/trace_choice.hpp"

#include <vector>

#include "core/names.hpp"

namespace scanbench::study {

bool TraceChoice::wants(std::string_view slot, std::string_view name) const {
  if (all) return true;
  const std::string prefix = std::string(slot) + ".";
  if (!name.empty()) return names.contains(prefix + std::string(name));
  const auto first = names.lower_bound(prefix);
  return first != names.end() && first->starts_with(prefix);
}

std::string TraceChoice::text() const {
  if (all) return "all";
  return names.empty() ? "none" : join(std::vector(names.begin(), names.end()), " ");
}

}  // namespace scanbench::study
