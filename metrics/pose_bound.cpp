// Information of surfaces about poses. A surface seen by both scans has the information A1 and A2 about (offset, angle)
// at one of its points; the difference of the two places has the covariance A1^-1 + A2^-1, whose inverse is
// A1 (A1 + A2)^-1 A2: it exists also where one beam alone sees the surface.
#include "metrics/pose_bound.hpp"

#include <cmath>
#include <limits>
#include <map>

#include <Eigen/LU>

#include "core/geometry/symmetric_matrix.hpp"
#include "metrics/line_bound.hpp"

namespace scanbench::metrics {

PoseInformation pose_information(const MetricInput& input, const Surfaces& surfaces, std::size_t reference,
                                 std::size_t frame) {
  const auto& poses = input.truth->world_from_sensor;
  const Pose2 reference_from_frame = poses[reference].inverse() * poses[frame];
  const std::map<int, SurfaceView> before = views_of(input, surfaces, reference),
                                   now = views_of(input, surfaces, frame);
  PoseInformation result;
  for (const auto& [surface, view] : now) {
    if (view.beams == 0) continue;
    const Vec2 normal = reference_from_frame.rotate(view.line.normal());
    const Vec2 arm = reference_from_frame.rotate(view.middle);
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian << normal.x(), normal.y(), normal.dot(perpendicular(arm)), 0.0, 0.0, 1.0;
    const Eigen::Matrix2d own = information_at(view, view.middle, view.line.normal());
    result.known_map += jacobian.transpose() * own * jacobian;
    const auto other = before.find(surface);
    if (other == before.end() || other->second.beams == 0) continue;
    const Eigen::Matrix2d theirs = information_at(other->second, reference_from_frame * view.middle, normal);
    const Eigen::Matrix2d sum = own + theirs;
    if (!(sum.determinant() > 1e-12 * sum(0, 0) * sum(1, 1))) continue;
    result.unknown_walls += jacobian.transpose() * (theirs * sum.inverse() * own) * jacobian;
    ++result.surfaces;
  }
  return result;
}

double weakest_sigma_m(const Eigen::Matrix3d& information, double lever_m) {
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / lever_m);
  const Eigen::Matrix3d metres = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::Vector3d values = symmetric_eigenvalues(metres);
  return values(0) > 1e-12 * values(2) ? 1.0 / std::sqrt(values(0)) : std::numeric_limits<double>::infinity();
}

}  // namespace scanbench::metrics
