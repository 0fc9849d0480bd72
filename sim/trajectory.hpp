// Scripted trajectories: where the sensor is when each scan begins.
#pragma once

#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/pose2.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

struct TimedPose {
  double stamp_s = 0.0;
  Pose2 world_from_sensor;
};

struct Trajectory {
  std::vector<TimedPose> poses;  ///< one per scan, stamps increasing
  NamedPoints waypoints;         ///< for figures; may be empty
  bool continuous = true;        ///< the sensor moves from pose to pose (false: it is placed)
};

/// A kind of trajectory: waypoints, spiral, step_and_shoot, poses, robots. Registered in Registry<TrajectoryKind>.
class TrajectoryKind {
 public:
  static constexpr std::string_view kKind = "trajectory";
  virtual ~TrajectoryKind() = default;
  /// `scan_period_s`: the sensor's, where scans are not spaced otherwise. Throws ConfigError for parameters that make
  /// no path.
  virtual Trajectory generate(double scan_period_s) const = 0;
};

/// Throws ConfigError, naming the wall and the place, if a continuous path crosses a wall, or a pose lies on a wall,
/// inside a round body, or outside any free space (every beam direction from it is open to infinity).
void check_clear(const World& world, const Trajectory& trajectory);

}  // namespace scanbench::sim
