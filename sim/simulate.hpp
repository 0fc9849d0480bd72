// World + sensor + trajectory + seed -> Recording. The same seed gives the same bytes for any number of threads.
#pragma once

#include <cstdint>
#include <functional>

#include "core/recording.hpp"
#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// Odometry as wheels give it (errors grow with the way) and as somebody who places a sensor gives it (independent per
/// pose).
struct OdometryNoise {
  double translation_per_m = 0.0;      ///< standard deviation [m] per metre driven
  double rotation_per_m_rad = 0.0;     ///< standard deviation [rad] per metre driven
  double rotation_per_rad = 0.0;       ///< standard deviation [rad] per radian turned
  double pose_position_sigma_m = 0.0;  ///< independent per pose, each axis
  double pose_heading_sigma_rad = 0.0;
};

struct SimulationInput {
  World world;
  SensorModel sensor;
  Trajectory trajectory;
  OdometryNoise odometry;
  bool sweep = false;  ///< the scan is swept while the sensor moves: sensor.time_per_beam_s per beam
  std::uint64_t seed = 1;
};

/// Bytes that simulate() will hold at once, for the check against the memory limit before it starts.
std::uint64_t memory_estimate(const SimulationInput& input);

/// Calls check_clear() first. `threads` >= 1; `progress` gets the share done, from one thread at a time.
Recording simulate(const SimulationInput& input, int threads = 1, const std::function<void(double)>& progress = {});

}  // namespace scanbench::sim
