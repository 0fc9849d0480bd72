// The clusterings of mean-shift merging: phase 1 by direction and place, phase 2 by collinearity (Lakaemper 2009,
// sections IV.B and IV.C, eqs 3-6).
#pragma once

#include <span>
#include <vector>

#include "algorithms/merge/parts/joint_space.hpp"
#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

enum class Kernel2 { rotated, printed };

/// Lengths in metres, angles in radians.
struct Kernels {
  double sigma_m;      ///< standard deviation of K1 in every dimension (eq. 3)
  double h_rad_per_m;  ///< bandwidth: the difference of direction that counts as one metre (eq. 4)
  double sigma_x_m;    ///< standard deviation of K2 along the direction of the cluster
  double sigma_y_m;    ///< standard deviation of K2 across it
  double factor;       ///< factor of both variances of K2
  Kernel2 form;
  double epsilon1_m;  ///< labelling distance of phase 1, in the metric of eq. 4
  double epsilon2;    ///< labelling distance of phase 2, in units of sigma_x along and sigma_y across
  double ridge_dip;   ///< largest fall of density between linked modes of one ridge, as a share; 0: no such links
  double cutoff;      ///< cut-off of kernels during climbs, in standard deviations
  bool accelerate;    ///< Newton steps where shifts are short
  bool capture;       ///< end climbs as soon as they are near a known mode
};

/// One entry per piece. Clusters are numbered in the order of their first pieces.
struct Clustering {
  std::vector<int> cluster;
  std::vector<Vec3> end;  ///< where the piece's point converged: (x, y, alpha), metres and radians in [0, pi)
  std::vector<std::vector<Vec3>> paths;  ///< from the piece's point to its end; empty unless requested
  int clusters = 0;
  bool converged = true;
};

/// Eqs 1, 3 and 4: modes of the joint space, labels by connected components within epsilon1.
Clustering cluster_directions(std::span<const Piece> pieces, const Kernels& kernels, bool with_paths);

/// Eqs 1, 5 and 6: for each cluster of phase 1, the modes of its centres under a kernel that is long in the direction
/// directions[cluster]. The third entry of an end is that direction.
Clustering cluster_collinear(std::span<const Piece> pieces, std::span<const int> cluster1,
                             std::span<const double> directions, const Kernels& kernels, bool with_paths);

/// Pieces by cluster, each in ascending order.
std::vector<std::vector<int>> members_of(std::span<const int> cluster, int clusters);

/// Unit vector of the long axis of K2 for a cluster direction.
Vec2 kernel2_axis(Kernel2 form, double theta_rad);

}  // namespace scanbench::merge
