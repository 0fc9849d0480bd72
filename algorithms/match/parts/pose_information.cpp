// Eigenvalues of the normal matrix, scaled to metres.
#include "algorithms/match/parts/pose_information.hpp"

#include <algorithm>

#include "core/geometry/symmetric_matrix.hpp"

namespace scanbench::matching {
namespace {

constexpr double kLeastEigenvalue = 1e-12;  // of the largest: what rounding leaves of nothing

Eigen::Vector3d scales(double lever_m) {
  return {1.0, 1.0, lever_m};
}

}  // namespace

Pose2 moved(const Pose2& pose, const Motion& motion) {
  const Pose2 turned = Pose2(0, 0, motion.z()) * Pose2::from_unit({0, 0}, {pose.cos(), pose.sin()});
  return Pose2::from_unit(pose.translation() + motion.head<2>(), {turned.cos(), turned.sin()});
}

Motion motion_between(const Pose2& from, const Pose2& to) {
  const Vec2 shift = to.translation() - from.translation();
  const double sine = from.cos() * to.sin() - from.sin() * to.cos();
  const double cosine = from.cos() * to.cos() + from.sin() * to.sin();
  return {shift.x(), shift.y(), std::atan2(sine, cosine)};
}

Determined::Determined(const PoseEquations& equations, double lever_m, double least_ratio) : lever_m_(lever_m) {
  const Eigen::Vector3d to_metres = scales(lever_m).cwiseInverse();
  const Eigen::Matrix3d matrix = to_metres.asDiagonal() * equations.matrix * to_metres.asDiagonal();
  const Eigen::Matrix3d by_chance = to_metres.asDiagonal() * equations.by_chance * to_metres.asDiagonal();
  const SymmetricEigen<Eigen::Matrix3d> eigen = symmetric_eigen(matrix);
  motions_ = eigen.vectors;
  const double largest = eigen.values(2);
  for (int k = 0; k < 3; ++k) {
    const double value = eigen.values(k);
    const double chance = motions_.col(k).dot(by_chance * motions_.col(k));
    if (!(value > kLeastEigenvalue * largest) || !(value > least_ratio * chance)) continue;
    inverse_(k) = 1.0 / value;
    ++rank_;
  }
}

Motion Determined::solve(const Motion& rhs) const {
  const Eigen::Vector3d scaled = rhs.cwiseQuotient(scales(lever_m_));
  const Eigen::Vector3d solution = motions_ * inverse_.cwiseProduct(motions_.transpose() * scaled);
  return solution.cwiseQuotient(scales(lever_m_));
}

Motion Determined::project(const Motion& motion) const {
  Eigen::Vector3d along = motions_.transpose() * motion.cwiseProduct(scales(lever_m_));
  for (int k = 0; k < 3; ++k)
    if (inverse_(k) == 0.0) along(k) = 0.0;
  return (motions_ * along).cwiseQuotient(scales(lever_m_));
}

Eigen::Matrix3d Determined::covariance(double scale) const {
  Eigen::Vector3d variances = scale * inverse_;
  for (int k = 0; k < 3; ++k)
    if (inverse_(k) == 0.0) variances(k) = kOpenMotionM * kOpenMotionM;
  const Eigen::Vector3d to_metres = scales(lever_m_).cwiseInverse();
  const Eigen::Matrix3d metres = motions_ * variances.asDiagonal() * motions_.transpose();
  return to_metres.asDiagonal() * metres * to_metres.asDiagonal();
}

}  // namespace scanbench::matching
