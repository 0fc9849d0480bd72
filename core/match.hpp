// The pose of one scan relative to another, and how well it is known.
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"

namespace scanbench {

/// Outcome of an estimator. `degenerate`: the scans leave at least one motion open (along a corridor, say).
/// `no_match`: the scans have too little in common.
enum class Status { converged, max_iterations, degenerate, no_match };
std::string_view to_string(Status status);

/// Standard deviation along a motion that the scans leave open, in metres of (x, y, lever * yaw): far more than any
/// scan could leave to chance, and small enough for an eigenvalue solver to keep the other directions exact.
inline constexpr double kOpenMotionM = 100.0;

/// The pose of the current scan in the frame of the reference scan.
struct Match {
  Status status = Status::converged;
  /// For `degenerate` the open motion is that of the guess; for `no_match` all of it is.
  Pose2 reference_from_current;
  /// Of the errors of (x, y, yaw) [m, m, rad], about the pose and in the reference frame's axes. Zero: not estimated.
  /// It is finite for `degenerate` too: a motion that the scans leave open has the variance kOpenMotionM^2, so that it
  /// is the eigenvector of the largest eigenvalue (two open motions: of the two largest). A reader who wants the
  /// information matrix may invert it: open motions then have no information to speak of. For `no_match` it is zero.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace scanbench
