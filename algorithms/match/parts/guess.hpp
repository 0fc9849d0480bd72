// What the guess says about the pose, before the scans are matched.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "algorithms/match/parts/pose_information.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/pose2.hpp"

namespace scanbench::matching {

/// Normal errors, independent along the axes and in heading; but one heading in a hundred may be any, because wheels
/// slipped.
class Guess {
 public:
  Guess(const Pose2& pose, double sigma_m, double sigma_rad) : pose_(pose), sigma_m_(sigma_m), sigma_rad_(sigma_rad) {}

  const Pose2& pose() const { return pose_; }

  /// Of (x, y, yaw) [m², m², rad²], without slips.
  Eigen::Matrix3d covariance() const {
    return Eigen::Vector3d(sigma_m_ * sigma_m_, sigma_m_ * sigma_m_, sigma_rad_ * sigma_rad_).asDiagonal();
  }

  /// Inverse of the covariance.
  Eigen::Matrix3d information() const {
    return Eigen::Vector3d(1.0 / (sigma_m_ * sigma_m_), 1.0 / (sigma_m_ * sigma_m_), 1.0 / (sigma_rad_ * sigma_rad_))
        .asDiagonal();
  }

  /// The guess, turned by so many standard deviations.
  Pose2 turned(double sigmas) const { return moved(pose_, {0.0, 0.0, sigmas * sigma_rad_}); }

  /// Logarithm of the density of a pose over that of the guess itself without slips.
  double log_density(const Pose2& pose) const {
    const Motion off = motion_between(pose_, pose);
    const double any_heading = sigma_rad_ / std::sqrt(kTwoPi);
    return -0.5 * position(off) + std::log((1.0 - kSlips) * std::exp(-0.5 * heading(off)) + kSlips * any_heading);
  }

  /// True for a pose outside of 99.9 % of those that the guess allows without slips.
  bool excludes(const Pose2& pose) const {
    const Motion off = motion_between(pose_, pose);
    return position(off) + heading(off) > 16.3;  // chi-square with 3 degrees of freedom
  }

  /// The same for the position alone.
  bool excludes_position(const Pose2& pose) const {
    return position(motion_between(pose_, pose)) > 13.8;  // with 2
  }

  /// The part of the shift from the guess to a position that is beyond 95 % of those that the guess allows; zero
  /// within.
  Vec2 unexplained_shift(const Pose2& pose) const {
    constexpr double kMost = 5.99;  // with 2
    const Motion off = motion_between(pose_, pose);
    const double distance = position(off);
    return distance > kMost ? Vec2((1.0 - std::sqrt(kMost / distance)) * off.head<2>()) : Vec2(Vec2::Zero());
  }

 private:
  static constexpr double kSlips = 0.01;  ///< share of guesses whose heading may be any

  // Squared distances in standard deviations.
  double position(const Motion& off) const { return off.head<2>().squaredNorm() / (sigma_m_ * sigma_m_); }
  double heading(const Motion& off) const { return off.z() * off.z() / (sigma_rad_ * sigma_rad_); }

  Pose2 pose_;
  double sigma_m_;
  double sigma_rad_;
};

}  // namespace scanbench::matching
