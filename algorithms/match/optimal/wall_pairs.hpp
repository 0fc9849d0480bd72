// Walls that two scans share: which lines of the two scans belong together, and the information of each wall about the
// pose.
// docs/algorithms/scan_matching.md, section 3.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "algorithms/match/optimal/scan_lines.hpp"
#include "algorithms/match/parts/pose_information.hpp"

namespace scanbench::matching {

/// The place of a wall as the lines of one scan give it: (offset along a normal at a point, angle from that normal).
struct WallPlace {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// Lines of the reference and of the current scan that are one wall.
struct WallPair {
  std::vector<std::size_t> reference;
  std::vector<std::size_t> current;
  bool operator==(const WallPair&) const = default;
};

/// The knowledge of the pose before walls are paired.
struct PoseBelief {
  Pose2 reference_from_current;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// Each line is paired with the line of the other scan that it overlaps and from which it differs least, if belief and
/// both covariances allow the difference. Lines that share a partner are one wall if they agree among themselves.
std::vector<WallPair> pair_walls(std::span<const MeasuredLine> reference, std::span<const MeasuredLine> current,
                                 const PoseBelief& belief);

/// Doubt about the pose while pairs are being found.
struct PoseDoubt {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m, m, rad]; zero: no doubt
  /// True: the doubt is counted as an error of its own of every wall. Walls then count alike, and one that is known
  /// better than the others does not decide against them.
  bool of_each_wall = false;
};

/// Equations of the motion of the current scan, each wall weighted with the probability that its lines are one wall.
/// A wall is one in two ways, which are equally probable: what its lines doubt may move them apart, with their whole
/// covariances; or it moves both alike, because both scans see the wall from nearly one place, and only the noise of
/// the plain lines is between them.
/// That probability is of the difference which the lines and `doubt` allow. A pose that may be off by ten times the
/// noise of a line says nothing against the pair if they differ by as much.
struct WallEquations {
  PoseEquations equations;
  double misfit = 0.0;       ///< sum of weighted squared differences, in standard deviations
  double walls = 0.0;        ///< sum of the weights
  double coordinates = 0.0;  ///< that were measured: two of each wall and one of each lone return, times their weights
  /// Sum over the walls of the logarithm of the odds that a pair is one wall.
  double evidence = 0.0;
};
WallEquations wall_equations(std::span<const WallPair> walls, std::span<const MeasuredLine> reference,
                             std::span<const MeasuredLine> current, const Pose2& reference_from_current,
                             const PoseDoubt& doubt = {});

}  // namespace scanbench::matching
