// The information about a pose in measurements across surfaces: normal equations, the motions that they leave open, and
// the covariance, open motions included.
//
// A corridor leaves its axis open, but the normals of its walls are estimates. Their errors give the normal matrix a
// small eigenvalue along the axis instead of zero. Its expected size is known: a motion counts as determined only if
// its information is several times as large.
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"
#include "core/match.hpp"

namespace scanbench::matching {

/// A small change of a pose: its sensor shifts by (x, y) in the reference frame and turns about itself by yaw.
using Motion = Eigen::Vector3d;

/// Shifts and turns the pose.
Pose2 moved(const Pose2& pose, const Motion& motion);

/// The motion from one pose to another: moved(from, motion_between(from, to)) == to.
Motion motion_between(const Pose2& from, const Pose2& to);

/// Derivative by the motion of the coordinate along `normal` of a point that the sensor carries: `arm` is the point
/// minus the sensor's place, both in the reference frame.
inline Motion gradient(const Vec2& normal, const Vec2& arm) {
  return {normal.x(), normal.y(), normal.dot(perpendicular(arm))};
}

/// The normal equations of a motion, and the part of their matrix that comes from errors of the normals.
struct PoseEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();     ///< Fisher's information of the motion
  Eigen::Matrix3d by_chance = Eigen::Matrix3d::Zero();  ///< expected matrix along open motions, from errors of normals
  Motion rhs = Motion::Zero();

  /// A residual (observed minus predicted) of weight 1/variance along a normal whose angle has a variance of its own.
  void add(const Vec2& normal, const Vec2& arm, double residual, double weight, double angle_variance) {
    const Motion g = gradient(normal, arm);
    matrix.noalias() += weight * g * g.transpose();
    rhs += (weight * residual) * g;
    const Motion turned = gradient(perpendicular(normal), arm);
    by_chance.noalias() += (weight * angle_variance) * turned * turned.transpose();
  }
};

/// Which motions the equations determine. `lever_m` makes metres of radians, so that eigenvalues compare; a motion is
/// determined if its information is more than `least_ratio` times that by chance.
class Determined {
 public:
  Determined(const PoseEquations& equations, double lever_m, double least_ratio);

  int rank() const { return rank_; }
  /// Solution of the equations along what they determine, zero along what they leave open.
  Motion solve(const Motion& rhs) const;
  /// The motion without what the equations leave open.
  Motion project(const Motion& motion) const;
  /// Inverse of the information where it is determined, times `scale`; kOpenMotionM^2 along motions that are open.
  Eigen::Matrix3d covariance(double scale) const;

 private:
  double lever_m_;
  int rank_ = 0;
  Eigen::Matrix3d motions_ = Eigen::Matrix3d::Identity();  ///< columns, orthonormal, in (x, y, lever * yaw)
  Eigen::Vector3d inverse_ = Eigen::Vector3d::Zero();      ///< of the eigenvalues; 0: open
};

}  // namespace scanbench::matching
