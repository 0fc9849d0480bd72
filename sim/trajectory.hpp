// Scripted trajectories: the pose of the sensor at the start of each scan.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/params.hpp"
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
  bool stops = false;            ///< continuous, but it does not move while it scans: no motion distortion
  std::vector<Vec2> path;        ///< the path driven, if it is known better than from the poses; may be empty
};

/// A kind of trajectory: waypoints, spiral, step_and_shoot, poses, robots. Registered in Registry<TrajectoryKind>.
class TrajectoryKind {
 public:
  static constexpr std::string_view kKind = "trajectory";
  virtual ~TrajectoryKind() = default;
  /// `scan_period_s`: the sensor's; used unless the kind states its own times. Throws ConfigError for parameters that
  /// define no path.
  virtual Trajectory generate(double scan_period_s) const = 0;
};

/// The pose `time_s` after the scan `frame` began: SE(2) interpolation (constant twist) to the next pose; after the
/// last pose the last twist continues. The pose of the frame itself if the sensor is placed or stops.
Pose2 pose_during_scan(const Trajectory& trajectory, std::size_t frame, double time_s);

/// Throws ConfigError, naming the wall or body and the place in metres, if a continuous path crosses a wall or a round
/// body, or a pose is not finite, is on a wall (closer than 1 mm), inside a round body (moving ones at the pose's
/// stamp), or so far from everything that no beam can return within `range_max_m`. A world of a few walls in free air
/// is fine.
void check_clear(const World& world, const Trajectory& trajectory, double range_max_m);

}  // namespace scanbench::sim
