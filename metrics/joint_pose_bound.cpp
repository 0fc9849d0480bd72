// Assembly of the information of all poses, the choice of the scans that it determines, and the bound without their
// common motion.
#include "metrics/joint_pose_bound.hpp"

#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <Eigen/LU>

#include "core/geometry/symmetric_matrix.hpp"
#include "metrics/line_bound.hpp"

namespace scanbench::metrics {
namespace {

constexpr std::size_t kMostScans = 500;
constexpr double kPriorSigmaM = 100.0;  // far above any max_sigma_m; makes the information invertible

using Wide = Eigen::Matrix<double, 2, 3>;

/// What a scan says of a wall: place in the scan = to_wall * wall - to_pose * pose, with this information.
struct Sight {
  std::size_t scan = 0;
  Wide to_pose;
  Eigen::Matrix2d to_wall;
  Eigen::Matrix2d information;
};

Sight sight_of(const SurfaceView& view, const Pose2& world_from_sensor, const Segment& wall, std::size_t scan) {
  Sight sight{scan, {}, {}, information_at(view, view.middle, view.line.normal())};
  const Vec2 normal = world_from_sensor.rotate(view.line.normal());
  const Vec2 arm = world_from_sensor.rotate(view.middle);
  sight.to_pose << normal.x(), normal.y(), normal.dot(perpendicular(arm)), 0.0, 0.0, 1.0;
  // The offset of the wall is that of its midpoint, along the normal that this scan sees. A scan from the other side
  // sees the opposite normal, so the sign is that of a fixed normal of the wall.
  const double side = normal.dot(perpendicular(wall.direction())) < 0 ? -1.0 : 1.0;
  const double along = perpendicular(normal).dot(world_from_sensor * view.middle - wall.midpoint());
  sight.to_wall << side, -along, 0.0, 1.0;
  return sight;
}

/// Inverse on the range of a symmetric, positive semidefinite matrix: a wall that one beam sees has no angle.
Eigen::Matrix2d inverse_on_range(const Eigen::Matrix2d& matrix) {
  const SymmetricEigen<Eigen::Matrix2d> eigen = symmetric_eigen(matrix);
  Eigen::Vector2d inverse = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < 2; ++k)
    if (eigen.values(k) > 1e-12 * eigen.values(1)) inverse(k) = 1.0 / eigen.values(k);
  return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

Eigen::Index block(std::size_t scan) {
  return 3 * static_cast<Eigen::Index>(scan);
}

/// The matrix S.
Eigen::MatrixXd information_of(const MetricInput& input, std::size_t scans) {
  const Surfaces surfaces = join_walls(input.truth->walls);
  std::map<int, std::vector<Sight>> sights;
  for (std::size_t k = 0; k < scans; ++k)
    for (const auto& [surface, view] : views_of(input, surfaces, k))
      if (view.beams > 0)
        sights[surface].push_back(
            sight_of(view, input.truth->world_from_sensor[k], surfaces.segments[static_cast<std::size_t>(surface)], k));
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(block(scans), block(scans));
  for (const auto& [surface, of_wall] : sights) {
    Eigen::Matrix2d wall = Eigen::Matrix2d::Zero();
    for (const Sight& s : of_wall) wall += s.to_wall.transpose() * s.information * s.to_wall;
    const Eigen::Matrix2d inverse = inverse_on_range(wall);
    for (const Sight& a : of_wall) {
      const Eigen::Matrix<double, 3, 2> row = a.to_pose.transpose() * a.information * a.to_wall * inverse;
      information.block<3, 3>(block(a.scan), block(a.scan)) += a.to_pose.transpose() * a.information * a.to_pose;
      for (const Sight& b : of_wall)
        information.block<3, 3>(block(a.scan), block(b.scan)) -=
            row * b.to_wall.transpose() * b.information * b.to_pose;
    }
  }
  return information;
}

/// Change of the pose of `scan` if all scans move together by (x, y, yaw) about the origin.
Eigen::Matrix3d common_motion_of(const Pose2& scan) {
  Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
  motion.block<2, 1>(0, 2) = perpendicular(scan.translation());
  return motion;
}

/// Largest standard deviation of a motion of scan b in the frame of scan a.
double relative_sigma_m(const Eigen::MatrixXd& covariance, std::span<const Pose2> poses, std::size_t a, std::size_t b,
                        double lever_m) {
  // The pose of b moves with a, about a; what is left is relative.
  Eigen::Matrix<double, 3, 6> relative;
  relative.leftCols<3>() = -Eigen::Matrix3d::Identity();
  relative.block<2, 1>(0, 2) = -perpendicular(poses[b].translation() - poses[a].translation());
  relative.rightCols<3>().setIdentity();
  relative.row(2) *= lever_m;
  Eigen::Matrix<double, 6, 6> both;
  both << covariance.block<3, 3>(block(a), block(a)), covariance.block<3, 3>(block(a), block(b)),
      covariance.block<3, 3>(block(b), block(a)), covariance.block<3, 3>(block(b), block(b));
  const Eigen::Matrix3d of_motion = relative * both * relative.transpose();
  return std::sqrt(symmetric_eigenvalues(of_motion)(2));
}

/// The largest set of scans that are determined relative to one of them; the first of equally large ones.
std::vector<std::size_t> determined(const Eigen::MatrixXd& covariance, std::span<const Pose2> poses, double max_sigma_m,
                                    double lever_m) {
  std::vector<std::size_t> largest;
  for (std::size_t a = 0; a < poses.size(); ++a) {
    std::vector<std::size_t> set;
    for (std::size_t b = 0; b < poses.size(); ++b)
      if (a == b || relative_sigma_m(covariance, poses, a, b, lever_m) <= max_sigma_m) set.push_back(b);
    if (set.size() > largest.size()) largest = std::move(set);
  }
  return largest;
}

}  // namespace

std::optional<JointPoseBound> joint_pose_bound(const MetricInput& input, double max_sigma_m, double lever_m) {
  const std::vector<Pose2>& poses = input.truth->world_from_sensor;
  if (poses.size() < 2 || poses.size() > kMostScans) return std::nullopt;
  Eigen::MatrixXd information = information_of(input, poses.size());
  // A prior on every pose: the bound of P e does not see it but for 1 / kPriorSigmaM^2 of the information.
  for (Eigen::Index i = 0; i < information.rows(); ++i)
    information(i, i) += (i % 3 == 2 ? lever_m * lever_m : 1.0) / (kPriorSigmaM * kPriorSigmaM);
  const Eigen::MatrixXd covariance = inverse_of_definite(information);

  JointPoseBound bound;
  bound.scans = determined(covariance, poses, max_sigma_m, lever_m);
  if (bound.scans.size() < 2) return std::nullopt;
  const std::size_t n = bound.scans.size();
  Eigen::MatrixXd chosen(block(n), block(n)), common(block(n), 3);
  Eigen::VectorXd weight(block(n));
  for (std::size_t a = 0; a < n; ++a) {
    common.middleRows<3>(block(a)) = common_motion_of(poses[bound.scans[a]]);
    weight.segment<3>(block(a)) = Eigen::Vector3d(1.0, 1.0, lever_m * lever_m);
    for (std::size_t b = 0; b < n; ++b)
      chosen.block<3, 3>(block(a), block(b)) = covariance.block<3, 3>(block(bound.scans[a]), block(bound.scans[b]));
  }
  const Eigen::MatrixXd weighted = common.transpose() * weight.asDiagonal();
  const Eigen::MatrixXd projection =
      Eigen::MatrixXd::Identity(block(n), block(n)) - common * (weighted * common).inverse() * weighted;
  const Eigen::VectorXd variance = (projection * chosen).cwiseProduct(projection).rowwise().sum();
  for (std::size_t a = 0; a < n; ++a) {
    bound.position.push_back(variance(block(a)) + variance(block(a) + 1));
    bound.heading.push_back(variance(block(a) + 2));
  }
  return bound;
}

}  // namespace scanbench::metrics
