// Looks for the trace rows that a figure draws.
#include "harness/results/figures/why_not_drawn.hpp"

#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/names.hpp"

namespace scanbench::results {

std::string why_not_drawn(const render::Figure& figure, const render::FigureInput& input) {
  std::set<std::string> wanted;
  for (const render::NamedResult& result : input.results)
    for (const std::string& row : figure.trace_rows(result.pipeline)) {
      if (result.trace != nullptr && result.trace->contains(row)) return figure.why_nothing(input);
      wanted.insert(row);
    }
  if (wanted.empty()) return figure.why_nothing(input);
  const std::vector<std::string> rows(wanted.begin(), wanted.end());
  return fmt::format("no pipeline has the trace rows {}; `scanbench run --trace` keeps all that there are", join(rows));
}

}  // namespace scanbench::results
