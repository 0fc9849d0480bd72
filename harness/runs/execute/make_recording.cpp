// Makes the recording of a scenario, after a check of the memory that it needs.
#include "harness/runs/execute/make_recording.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "harness/io/exchange/log.hpp"
#include "harness/io/exchange/pose_relations.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/study/scenario/line_set.hpp"
#include "sim/odometry.hpp"

namespace scanbench::runs {
namespace {

void refuse_if_too_large(const study::Scenario& scenario, double needed, std::size_t frames) {
  if (needed <= scenario.limits.memory_bytes) return;
  const auto& input = std::get<study::SimulatedInput>(scenario.input);
  throw ConfigError(fmt::format(
      "{}: the recording needs about {} ({} frames x {} beams x 20 B for range, true range and wall id, and {} walls); "
      "allowed: limits.memory_mib = {} MiB; take fewer scans or beams, or raise the limit",
      scenario.path.string(), io::size_text(needed), frames, input.sensor.geometry.beams(), input.world.walls.size(),
      scenario.limits.memory_bytes / (1024.0 * 1024.0)));
}

/// Checks a stated number of scans before it generates their poses, because ten million poses take seconds.
sim::SimulationInput input_within_memory(const study::Scenario& scenario, std::uint64_t seed) {
  const auto& simulated = std::get<study::SimulatedInput>(scenario.input);
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
  sim::SimulationInput input = study::simulation_input(scenario, seed);
  refuse_if_too_large(scenario, static_cast<double>(sim::memory_estimate(input)), input.trajectory.poses.size());
  return input;
}

/// Every scan of a log, of which `recording` holds those that the input reads. The poses are those that estimates are
/// compared with, if the log has such, because they are better than those that algorithms get.
io::RelatedScans related_scans(const study::RecordedInput& input, const Recording& recording, double max_bytes) {
  io::RelatedScans scans;
  scans.every = static_cast<std::size_t>(std::get<std::int64_t>(input.params.at("every")));
  scans.frames = recording.observed.frames.size();
  ParamSet every_scan = input.params;
  every_scan["every"] = std::int64_t{1};
  every_scan["max_frames"] = std::int64_t{0};
  const Recording all =
      scans.every == 1 ? recording : io::read_log(input.log, input.format, every_scan, input.sensor, max_bytes);
  for (const Frame& frame : all.observed.frames) {
    scans.stamps_s.push_back(frame.stamp_s);
    scans.world_from_sensor.push_back(frame.odom_from_sensor);
  }
  if (all.reference && !all.reference->world_from_sensor.empty())
    scans.world_from_sensor = all.reference->world_from_sensor;
  return scans;
}

Recording recorded_log(const study::RecordedInput& input, double max_bytes, std::uint64_t seed) {
  Recording recording = io::read_log(input.log, input.format, input.params, input.sensor, max_bytes);
  if (!input.relations.empty()) {
    if (!recording.reference) recording.reference.emplace();
    recording.reference->relations = io::read_relations(input.relations, related_scans(input, recording, max_bytes),
                                                        io::sensor_place(input.format, input.params));
  }
  if (!input.odometry.any()) return recording;
  std::vector<Pose2> poses;
  for (const Frame& frame : recording.observed.frames) poses.push_back(frame.odom_from_sensor);
  poses = sim::odometry_poses(poses, input.odometry, seed);
  for (std::size_t k = 0; k < poses.size(); ++k) recording.observed.frames[k].odom_from_sensor = poses[k];
  return recording;
}

}  // namespace

void check_scenario(const study::Scenario& scenario) {
  if (const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input))
    recorded_log(*recorded, scenario.limits.memory_bytes, 0);
  if (!std::holds_alternative<study::SimulatedInput>(scenario.input)) return;
  const sim::SimulationInput input = input_within_memory(scenario, 0);
  try {
    sim::check_clear(input.world, input.trajectory, input.sensor.range_max_m);
  } catch (const ConfigError& error) {
    throw ConfigError(study::trajectory_place(scenario) + ": " + error.what());
  }
}

Recording make_recording(const study::Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress) {
  if (const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input))
    return recorded_log(*recorded, scenario.limits.memory_bytes, seed);
  if (const auto* lines = std::get_if<study::LinesInput>(&scenario.input))
    return lines->file.empty() ? sim::line_copies(*lines->world, lines->copies, seed)
                               : study::line_set_recording(lines->frames, lines->world ? &*lines->world : nullptr);
  const sim::SimulationInput input = input_within_memory(scenario, seed);
  try {
    return sim::simulate(input, threads, progress);
  } catch (const ConfigError& error) {
    throw ConfigError(study::trajectory_place(scenario) + ": " + error.what());
  }
}

}  // namespace scanbench::runs
