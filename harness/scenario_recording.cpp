// From a scenario to its recording, after a look at the memory that it will need.
#include <fmt/format.h>

#include "core/registry.hpp"
#include "harness/log.hpp"
#include "harness/scenario.hpp"
#include "harness/text_file.hpp"

namespace scanbench::harness {
namespace {

void check_memory(const Scenario& scenario, const sim::SimulationInput& input) {
  const auto needed = static_cast<double>(sim::memory_estimate(input));
  if (needed <= scenario.limits.memory_bytes) return;
  throw ConfigError(fmt::format(
      "{}: the recording needs about {} ({} frames x {} beams x 20 B for range, true range and wall id, and {} walls); "
      "allowed: limits.memory_mib = {} MiB; take fewer scans or beams, or raise the limit",
      scenario.path.string(), size_text(needed), input.trajectory.poses.size(), input.sensor.geometry.beams(),
      input.world.walls.size(), scenario.limits.memory_bytes / (1024.0 * 1024.0)));
}

}  // namespace

sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed) {
  const auto* simulated = std::get_if<SimulatedInput>(&scenario.input);
  SCANBENCH_ASSERT(simulated != nullptr);
  const auto& [kind, name, params] = simulated->trajectory;
  return {.world = simulated->world,
          .sensor = simulated->sensor,
          .trajectory = Registry<sim::TrajectoryKind>::make(name, params)->generate(simulated->sensor.scan_period_s),
          .odometry = simulated->odometry,
          .sweep = simulated->sweep,
          .seed = seed};
}

void check_scenario(const Scenario& scenario) {
  if (!std::holds_alternative<SimulatedInput>(scenario.input)) return;
  const sim::SimulationInput input = simulation_input(scenario, 0);
  check_memory(scenario, input);
  try {
    sim::check_clear(input.world, input.trajectory);
  } catch (const ConfigError& error) {
    throw ConfigError(scenario.path.string() + ": " + error.what());
  }
}

Recording make_recording(const Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress) {
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input))
    return read_log(recorded->log, recorded->format, recorded->params, recorded->sensor, scenario.limits.memory_bytes);
  const sim::SimulationInput input = simulation_input(scenario, seed);
  check_memory(scenario, input);
  try {
    return sim::simulate(input, threads, progress);
  } catch (const ConfigError& error) {
    throw ConfigError(scenario.path.string() + ": " + error.what());
  }
}

}  // namespace scanbench::harness
