// Construction of scenarios and predicates on them.
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::study {

Scenario::Scenario() = default;
Scenario::Scenario(const Scenario&) = default;
Scenario::Scenario(Scenario&&) noexcept = default;
Scenario& Scenario::operator=(const Scenario&) = default;
Scenario& Scenario::operator=(Scenario&&) noexcept = default;
Scenario::~Scenario() = default;

bool has_chance(const Scenario& scenario) {
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input)) return lines->file.empty();
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input)) return recorded->odometry.any();
  return true;
}

}  // namespace scanbench::study
