// Cramer-Rao bound of the poses of many scans that were aligned together, without the motion that is common to all.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "metrics/metric.hpp"

namespace scanbench::metrics {

/// The bound of the scans whose poses relative to each other the data determine.
struct JointPoseBound {
  std::vector<std::size_t> scans;  ///< increasing; at least two
  std::vector<double> position;    ///< per scan the smallest mean squared error of its position [m^2]
  std::vector<double> heading;     ///< the same of its heading [rad^2]
};

/// Poses and walls are unknown, as they are to an aligner. The wall l has an offset and an angle (w_l), and the scan k
/// a pose p_k = (x, y, yaw) in the world. To first order, scan k shows the wall at the place W_kl w_l - J_kl p_k, in
/// its own frame, with the information A_kl that its beams have about a line (line_bound.hpp). Eliminating all w_l
/// from the sum of the squared residuals leaves the Fisher information of the poses,
///
///   S = sum_kl J_kl' A_kl J_kl - sum_l B_l C_l^-1 B_l',  B_l = stack_k(J_kl' A_kl W_kl),  C_l = sum_k W_kl' A_kl W_kl.
///
/// A motion N of all scans together changes nothing: S N = 0. Errors e are therefore compared after the projection
/// P = 1 - N (N' M N)^-1 N' M, M = diag(1, 1, lever^2), which is the removal of the common motion that minimises
/// sum |position|^2 + lever^2 heading^2, to first order. P e is a function of what is observable, and the covariance of
/// any unbiased estimate of it is at least P S^- P', for every generalised inverse S^-. With known walls the first sum
/// alone is the information; that bound (Censi, ICRA 2007) is smaller, and no aligner reaches it.
///
/// A scan can slide along a corridor, and groups of scans may share no wall. The bound is therefore that of the scans
/// whose pose in the frame of one of them is determined to `max_sigma_m` in every direction, yaw counted at
/// `lever_m`; that one is chosen so that they are most. The common motion is that of these scans.
///
/// The input must satisfy has_beam_truth(), and the sensor must have noise. Nothing if no two scans determine each
/// other, and for more than 500 scans: the matrices are dense.
std::optional<JointPoseBound> joint_pose_bound(const MetricInput& input, double max_sigma_m, double lever_m);

}  // namespace scanbench::metrics
