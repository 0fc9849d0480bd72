// Difference of two poses.
#include "core/geometry/pose_errors.hpp"

#include <cmath>

namespace scanbench {

Eigen::Vector3d pose_error(const Pose2& found, const Pose2& truth) {
  const Vec2 shift = found.translation() - truth.translation();
  const double sine = truth.cos() * found.sin() - truth.sin() * found.cos();
  const double cosine = truth.cos() * found.cos() + truth.sin() * found.sin();
  return {shift.x(), shift.y(), std::atan2(sine, cosine)};
}

}  // namespace scanbench
