// Collects the world, the sensor and the generated trajectory of a scenario.
#include "harness/scenario/simulation_input.hpp"

#include <variant>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::harness {

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

}  // namespace scanbench::harness
