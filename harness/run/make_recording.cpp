// Makes the recording of a scenario, after a check of the memory that it needs.
#include "harness/run/make_recording.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "harness/exchange/line_set.hpp"
#include "harness/exchange/log.hpp"
#include "harness/exchange/pose_relations.hpp"
#include "harness/files/text_file.hpp"

namespace scanbench::harness {
namespace {

void refuse_if_too_large(const Scenario& scenario, double needed, std::size_t frames) {
  if (needed <= scenario.limits.memory_bytes) return;
  const auto& input = std::get<SimulatedInput>(scenario.input);
  throw ConfigError(fmt::format(
      "{}: the recording needs about {} ({} frames x {} beams x 20 B for range, true range and wall id, and {} walls); "
      "allowed: limits.memory_mib = {} MiB; take fewer scans or beams, or raise the limit",
      scenario.path.string(), size_text(needed), frames, input.sensor.geometry.beams(), input.world.walls.size(),
      scenario.limits.memory_bytes / (1024.0 * 1024.0)));
}

/// Checks a stated number of scans before it generates their poses, because ten million poses take seconds.
sim::SimulationInput input_within_memory(const Scenario& scenario, std::uint64_t seed) {
  const auto& simulated = std::get<SimulatedInput>(scenario.input);
  const auto stated = simulated.trajectory.params.find("scans");
  if (stated != simulated.trajectory.params.end()) {
    if (const auto* scans = std::get_if<std::int64_t>(&stated->second)) {
      sim::SimulationInput one{.world = simulated.world,
                               .sensor = simulated.sensor,
                               .trajectory = {},
                               .odometry = simulated.odometry,
                               .tilt = simulated.tilt,
                               .sweep = simulated.sweep,
                               .seed = seed};
      const auto none = static_cast<double>(sim::memory_estimate(one));
      one.trajectory.poses.resize(1);
      const double each = static_cast<double>(sim::memory_estimate(one)) - none;
      refuse_if_too_large(scenario, none + each * static_cast<double>(*scans), static_cast<std::size_t>(*scans));
    }
  }
  sim::SimulationInput input = simulation_input(scenario, seed);
  refuse_if_too_large(scenario, static_cast<double>(sim::memory_estimate(input)), input.trajectory.poses.size());
  return input;
}

Recording recorded_log(const RecordedInput& input, double max_bytes) {
  Recording recording = read_log(input.log, input.format, input.params, input.sensor, max_bytes);
  if (input.relations.empty()) return recording;
  std::vector<double> stamps;
  for (const Frame& frame : recording.observed.frames) stamps.push_back(frame.stamp_s);
  if (!recording.reference) recording.reference.emplace();
  recording.reference->relations = read_relations(input.relations, stamps, sensor_place(input.format, input.params));
  return recording;
}

}  // namespace

void check_scenario(const Scenario& scenario) {
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input))
    recorded_log(*recorded, scenario.limits.memory_bytes);
  if (!std::holds_alternative<SimulatedInput>(scenario.input)) return;
  const sim::SimulationInput input = input_within_memory(scenario, 0);
  try {
    sim::check_clear(input.world, input.trajectory, input.sensor.range_max_m);
  } catch (const ConfigError& error) {
    throw ConfigError(scenario.path.string() + ": " + error.what());
  }
}

Recording make_recording(const Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress) {
  if (const auto* recorded = std::get_if<RecordedInput>(&scenario.input))
    return recorded_log(*recorded, scenario.limits.memory_bytes);
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input))
    return lines->file.empty() ? sim::line_copies(*lines->world, lines->copies, seed)
                               : line_set_recording(lines->frames, lines->world ? &*lines->world : nullptr);
  const sim::SimulationInput input = input_within_memory(scenario, seed);
  try {
    return sim::simulate(input, threads, progress);
  } catch (const ConfigError& error) {
    throw ConfigError(scenario.path.string() + ": " + error.what());
  }
}

}  // namespace scanbench::harness
