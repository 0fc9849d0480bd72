// How well three matches of three scans agree: the way over the second scan against the direct one.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/match.hpp"

namespace scanbench::metrics {

/// Covariance of the errors of (x, y, yaw) of `a_from_b * b_from_c` along the axes of a [m, m, rad], to first order,
/// from those of its factors, whose errors are independent: each covariance is along the axes of its factor's own
/// reference (a and b), as in Match. The heading of a_from_b turns b_from_c about b.
Eigen::Matrix3d composed_covariance(const Pose2& a_from_b, const Eigen::Matrix3d& of_a_from_b, const Pose2& b_from_c,
                                    const Eigen::Matrix3d& of_b_from_c);

/// The difference of a composed pose and a direct one.
struct Closure {
  Eigen::Vector3d error;  ///< (x, y, yaw) along the axes of the first scan [m, m, rad]
  double square = 0.0;  ///< of the error over the sum of the three covariances, along the motions that none leaves open
  int freedom = 3;      ///< how many motions these are: 1 to 3
};

/// `second` is relative to the scan that `first` places, `both` relative to the reference of `first`. A motion that a
/// match leaves open (Status::degenerate) does not count: nothing is stated about it. Empty if a match is `no_match` or
/// states no covariance, or if every motion is open.
std::optional<Closure> closure_of(const Match& first, const Match& second, const Match& both);

/// The value of chi-square with three degrees of freedom that is exceeded as often as `square` is with `freedom`.
double as_three_degrees(double square, int freedom);

}  // namespace scanbench::metrics
