// Simulation of a recording from a world, a sensor, a trajectory and a seed. The same seed gives the same bytes for any
// number of threads.
#pragma once

#include <cstdint>
#include <functional>

#include "core/recording.hpp"
#include "core/sensor_model.hpp"
#include "sim/odometry.hpp"
#include "sim/ray_caster.hpp"
#include "sim/tilt.hpp"
#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

struct SimulationInput {
  World world;
  SensorModel sensor;
  Trajectory trajectory;
  OdometryNoise odometry;
  Tilt tilt;
  bool sweep = false;  ///< the scan is swept while the sensor moves: sensor.time_per_beam_s per beam
  std::uint64_t seed = 1;
  CasterKind caster = CasterKind::exact;
};

/// Bytes that simulate() will use at once, for the check against the memory limit before it starts.
std::uint64_t memory_estimate(const SimulationInput& input);

/// The scans of a trajectory and the truth behind them. Calls validate() and check_clear() first and throws what they
/// throw; ConfigError for a sweep with a sensor whose time_per_beam_s is 0. `threads` >= 1, else InternalError;
/// `progress` gets the completed share, from one thread at a time; an exception from it ends the simulation.
///
/// Truth ranges and wall ids are those of the nominal beams of a level sensor, each from the pose it was fired from.
/// The first odometry pose is the true pose (sim/odometry.hpp).
Recording simulate(const SimulationInput& input, int threads = 1, const std::function<void(double)>& progress = {});

}  // namespace scanbench::sim
