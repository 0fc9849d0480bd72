// Collects the world, the sensor and the generated trajectory of a scenario.
#include "harness/study/scenario/simulation_input.hpp"

#include <fmt/format.h>

#include <string>
#include <variant>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/io/yaml/gate.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::study {

sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed) {
  const auto* simulated = std::get_if<SimulatedInput>(&scenario.input);
  SCANBENCH_ASSERT(simulated != nullptr);
  const auto& [kind, name, params, source] = simulated->trajectory;
  return {.world = simulated->world,
          .sensor = simulated->sensor,
          .trajectory = Registry<sim::TrajectoryKind>::make(name, params)->generate(simulated->sensor.scan_period_s),
          .odometry = simulated->odometry,
          .tilt = simulated->tilt,
          .sweep = simulated->sweep,
          .seed = seed,
          .caster = simulated->caster};
}

std::string trajectory_place(const Scenario& scenario) {
  const std::string file = scenario.path.string();
  const io::YamlNode root = io::parse_yaml(scenario.text, scenario.text.size());
  const io::YamlNode* node = root.find("trajectory");
  if (node == nullptr) return file;
  if (const io::YamlNode* points = node->find("points_m")) node = points;
  return fmt::format("{}:{}:{}", file, node->mark.line, node->mark.column);
}

}  // namespace scanbench::study
