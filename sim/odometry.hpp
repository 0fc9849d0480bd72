// Odometry errors: drift that grows with the distance driven, and independent errors of a sensor placed by hand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/params.hpp"

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

  bool any() const {
    return translation_per_m > 0 || rotation_per_m_rad > 0 || rotation_per_rad > 0 || pose_position_sigma_m > 0 ||
           pose_heading_sigma_rad > 0;
  }

  static auto fields() {
    using P = OdometryNoise;
    return std::tuple{field("translation_per_m", &P::translation_per_m, at_least(0), "m",
                            "standard deviation of the distance after one metre, along the motion"),
                      degrees_field("rotation_per_m_deg", &P::rotation_per_m_rad, at_least(0),
                                    "standard deviation of the heading after one metre"),
                      field("rotation_per_rad", &P::rotation_per_rad, at_least(0), "rad",
                            "standard deviation of the heading after turning by one radian"),
                      field("pose_position_sigma_m", &P::pose_position_sigma_m, at_least(0), "m",
                            "standard deviation of each coordinate, independent per pose"),
                      degrees_field("pose_heading_sigma_deg", &P::pose_heading_sigma_rad, at_least(0),
                                    "standard deviation of the heading, independent per pose")};
  }
};

/// Odometry poses for true ones, same length. The first is the true pose: odometry has no error before it moves, and
/// the odometry frame is the world frame. Without noise all are the true poses, bit for bit.
std::vector<Pose2> odometry_poses(std::span<const Pose2> world_from_sensor, const OdometryNoise& noise,
                                  std::uint64_t seed);

}  // namespace scanbench::sim
