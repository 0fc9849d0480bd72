// Predicates on scenarios.
#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

bool has_chance(const Scenario& scenario) {
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input)) return lines->file.empty();
  return std::holds_alternative<SimulatedInput>(scenario.input);
}

}  // namespace scanbench::harness
