// What the beams of one scan say of the place of each surface.
#pragma once

#include <map>

#include <Eigen/Core>

#include "metrics/line_matching.hpp"

namespace scanbench::metrics {

/// Sensor frame.
struct SurfaceView {
  PolarLine line;                                         ///< true
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< Fisher information of (rho, alpha)
  Vec2 middle = Vec2::Zero();                             ///< mean of the true points
  int beams = 0;
};

/// The views of a frame by surface, from the valid returns whose beams truly end on one. The input must satisfy
/// has_beam_truth(), and the sensor must have noise.
std::map<int, SurfaceView> views_of(const MetricInput& input, const Surfaces& surfaces, std::size_t frame);

/// Information of (offset along `normal`, angle) at `point` of the line, all in the scan's frame.
Eigen::Matrix2d information_at(const SurfaceView& view, const Vec2& point, const Vec2& normal);

}  // namespace scanbench::metrics
