// Cramer-Rao bounds of the pose of one scan relative to another.
#pragma once

#include <Eigen/Core>

#include "metrics/line_matching.hpp"

namespace scanbench::metrics {

/// Fisher information of (x, y, yaw) of a frame's sensor about its true place in the frame of its reference; x and y
/// along the reference's axes, yaw about the sensor.
struct PoseInformation {
  /// The walls are known and only the frame's readings are noisy (Censi, "On achievable accuracy for range-finder
  /// localization", ICRA 2007): no matcher of two scans reaches it.
  Eigen::Matrix3d known_map = Eigen::Matrix3d::Zero();
  /// Each surface that both scans see has a place that is known from their readings alone: what a matcher that is told
  /// which beams see which surface can reach.
  Eigen::Matrix3d unknown_walls = Eigen::Matrix3d::Zero();
  int surfaces = 0;  ///< seen by both
};

/// From the valid returns whose beams truly end on a surface, with the sensor's noise at the true ranges. The input
/// must satisfy has_beam_truth(), and the sensor must have noise.
PoseInformation pose_information(const MetricInput& input, const Surfaces& surfaces, std::size_t reference,
                                 std::size_t frame);

/// Standard deviation [m] along the motion that the information determines least, yaw counted at `lever_m`; infinite
/// where it determines none.
double weakest_sigma_m(const Eigen::Matrix3d& information, double lever_m);

}  // namespace scanbench::metrics
