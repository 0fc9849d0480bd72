// The information of the beams of one scan about lines and surfaces, and the Cramer-Rao bound of a line.
#pragma once

#include <map>
#include <optional>

#include <Eigen/Core>

#include "metrics/walls/true_lines.hpp"

namespace scanbench::metrics {

/// Fisher information of the reading of one beam about (rho, alpha) of the line that it meets; zero for a beam that
/// runs along or away from it. Absent for a sensor without noise.
std::optional<Eigen::Matrix2d> beam_information(const SensorModel& sensor, int beam, const PolarLine& line);

/// The smallest covariance of any unbiased estimate of (offset of the line at the midpoint of truth.segment [m], angle
/// [rad]) from the returns between the line's first and last beam. The offset is along the line's canonical normal, the
/// angle counter-clockwise, as in LineFeature::covariance. Absent if there is no bound: the sensor has no noise, or the
/// beams do not determine the line.
std::optional<Eigen::Matrix2d> line_bound(const Scan& scan, const TrueLine& truth);

/// What the beams of one scan say of the place of a surface, sensor frame.
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
