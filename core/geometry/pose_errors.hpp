// Errors of estimated poses.
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"

namespace scanbench {

/// (x, y, yaw) of `found` minus those of `truth`, along the axes of the frame that both are given in; yaw on the
/// circle.
Eigen::Vector3d pose_error(const Pose2& found, const Pose2& truth);

}  // namespace scanbench
