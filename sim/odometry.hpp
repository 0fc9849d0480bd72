// Odometry errors: drift that grows with the distance driven, and independent errors of a sensor placed by hand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose2.hpp"

namespace scanbench::sim {

/// Drift of wheel odometry, and independent errors of hand-placed poses. Drift is a random walk: its variance is
/// proportional to the distance driven, so it does not depend on the number of scans; the values are standard
/// deviations after one metre or one radian.
struct OdometryNoise {
  double translation_per_m = 0.0;      ///< standard deviation [m] per metre driven, along the motion
  double rotation_per_m_rad = 0.0;     ///< standard deviation [rad] per metre driven
  double rotation_per_rad = 0.0;       ///< standard deviation [rad] per radian of rotation
  double pose_position_sigma_m = 0.0;  ///< independent per pose, each axis
  double pose_heading_sigma_rad = 0.0;
};

/// Odometry poses for true ones, same length. The first is the true pose: odometry has no error before it moves, and
/// the odometry frame is the world frame. Without noise all are the true poses, bit for bit.
std::vector<Pose2> odometry_poses(std::span<const Pose2> world_from_sensor, const OdometryNoise& noise,
                                  std::uint64_t seed);

}  // namespace scanbench::sim
