// Counts the scans of a scenario, and makes recordings of a few.
#include "harness/runs/execute/scan_source.hpp"

#include <chrono>
#include <cstdint>
#include <utility>
#include <variant>

#include "harness/runs/execute/make_recording.hpp"
#include "harness/study/scenario/simulation_input.hpp"

namespace scanbench::runs {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

ScanSource::ScanSource(const study::Scenario& scenario) {
  const std::uint64_t seed = scenario.seeds.front();
  if (std::holds_alternative<study::SimulatedInput>(scenario.input)) {
    check_scenario(scenario);
    input_ = study::simulation_input(scenario, seed);
    scans_ = input_.trajectory.poses.size();
    rays_ = static_cast<double>(scans_) * input_.sensor.geometry.beams();
    return;
  }
  const auto start = Clock::now();
  recording_ = make_recording(scenario, seed, 1);
  reading_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
  scans_ = recording_->observed.frames.size();
  for (const Frame& frame : recording_->observed.frames) rays_ += static_cast<double>(frame.ranges.size());
}

Recording ScanSource::sample(std::size_t count, int threads) const {
  const auto first = static_cast<std::ptrdiff_t>((scans_ - count) / 2);
  const auto last = first + static_cast<std::ptrdiff_t>(count);
  if (!recording_) {
    sim::SimulationInput part = input_;
    const auto& poses = input_.trajectory.poses;
    part.trajectory.poses.assign(poses.begin() + first, poses.begin() + last);
    return sim::simulate(part, threads);
  }
  Recording part = *recording_;
  part.observed.frames.assign(recording_->observed.frames.begin() + first, recording_->observed.frames.begin() + last);
  if (part.truth) {
    const auto beams = static_cast<std::ptrdiff_t>(part.observed.sensor.geometry.beams());
    const Truth& whole = *recording_->truth;
    part.truth->world_from_sensor.assign(whole.world_from_sensor.begin() + first,
                                         whole.world_from_sensor.begin() + last);
    part.truth->ranges.assign(whole.ranges.begin() + first * beams, whole.ranges.begin() + last * beams);
    part.truth->wall_ids.assign(whole.wall_ids.begin() + first * beams, whole.wall_ids.begin() + last * beams);
  }
  return part;
}

}  // namespace scanbench::runs
