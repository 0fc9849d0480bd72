// Predicates on scenarios and pipelines.
#include "harness/scenario/scenario.hpp"

#include <algorithm>

namespace scanbench::harness {

bool has_slot(const PipelineSpec& pipeline, std::string_view kind) {
  return std::ranges::find(pipeline.slots, kind, &ModuleChoice::kind) != pipeline.slots.end();
}

bool has_chance(const Scenario& scenario) {
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input)) return lines->file.empty();
  return std::holds_alternative<SimulatedInput>(scenario.input);
}

}  // namespace scanbench::harness
