// The Cramer-Rao bound of a line seen by the beams of one scan.
#pragma once

#include <optional>

#include "metrics/line_matching.hpp"

namespace scanbench::metrics {

/// Fisher information of the reading of one beam about (rho, alpha) of the line that it meets; zero for a beam that
/// runs along or away from it. Absent for a sensor without noise.
std::optional<Eigen::Matrix2d> beam_information(const SensorModel& sensor, int beam, const PolarLine& line);

/// Smallest covariance that an unbiased estimate of (offset of the line at the midpoint of truth.segment [m], angle
/// [rad]) can have, from the returns between the line's first and last beam. The offset counts along the line's
/// canonical normal, the angle counter-clockwise, as in LineFeature::covariance. Absent where the bound does not exist:
/// a sensor without noise, or beams that do not determine the line.
std::optional<Eigen::Matrix2d> line_bound(const Scan& scan, const TrueLine& truth);

}  // namespace scanbench::metrics
