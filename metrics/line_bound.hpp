// The Cramer-Rao bound of a line seen by the beams of one scan.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "metrics/true_lines.hpp"

namespace scanbench::metrics {

/// Fisher information of the reading of one beam about (rho, alpha) of the line that it meets; zero for a beam that
/// runs along or away from it. Absent for a sensor without noise.
std::optional<Eigen::Matrix2d> beam_information(const SensorModel& sensor, int beam, const PolarLine& line);

/// The smallest covariance of any unbiased estimate of (offset of the line at the midpoint of truth.segment [m], angle
/// [rad]) from the returns between the line's first and last beam. The offset is along the line's canonical normal, the
/// angle counter-clockwise, as in LineFeature::covariance. Absent if there is no bound: the sensor has no noise, or the
/// beams do not determine the line.
std::optional<Eigen::Matrix2d> line_bound(const Scan& scan, const TrueLine& truth);

}  // namespace scanbench::metrics
