// Predicates on scenarios.
#include "harness/scenario/scenario.hpp"

namespace scanbench::harness {

bool has_chance(const Scenario& scenario) {
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input)) return lines->file.empty();
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input)) return recorded->odometry.any();
  return true;
}

}  // namespace scanbench::harness
