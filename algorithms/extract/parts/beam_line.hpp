// Maximum-likelihood lines in the coordinates of the beams: errors are along the beam, with the standard deviation of
// the sensor. docs/algorithms/optimal.md, section 5.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "algorithms/extract/parts/beam_kernels.hpp"
#include "core/geometry/geometry.hpp"
#include "core/isa.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::extract {

/// A reading and the direction of its beam, sensor frame.
struct BeamReading {
  Vec2 direction = Vec2::Zero();
  double range_m = 0.0;
};

/// The line theta . p = 1, where theta is the unit normal divided by the distance. A beam in direction d meets it at
/// range 1 / (theta . d). Lines through the sensor have no theta; no beam sees them.
struct BeamLine {
  Vec2 theta = Vec2::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< Fisher information of theta

  double range(const Vec2& direction) const { return 1.0 / theta.dot(direction); }
  Vec2 normal() const { return theta.normalized(); }
  double rho() const { return 1.0 / theta.norm(); }
};

/// Noise of readings, prepared for sums over many of them: range noise, rounding and bearing noise. The standard
/// deviation is at least kLeastSigma, also for sensors without stated noise.
inline constexpr double kLeastSigma = 1e-3;
struct ReadingNoise : VarianceTerms {
  ReadingNoise(const SensorNoise& noise);  // NOLINT(google-explicit-constructor): the same noise, squared

  /// Variance of a reading at range r on a wall whose range changes by `slope` metres per radian of bearing.
  double variance(double r, double slope) const {
    const double relative = relative2 * r * r;
    const double gaussian =
        relative_from_m > 0 ? (r < relative_from_m ? constant_m2 : relative) : constant_m2 + relative;
    const double sum = gaussian + rounding_m2 + bearing_rad2 * slope * slope;
    return sum > least_m2 ? sum : least_m2;
  }
};

/// Standard deviation of a reading: the root of its variance.
double reading_sigma(const ReadingNoise& noise, double r, double slope);

/// The maximum-likelihood line by Gauss-Newton, from `start` if given, otherwise from the linear fit of inverse ranges.
/// The distance to the maximum is far below one ten-millionth of a standard deviation. Absent for fewer than two
/// readings, for readings of one beam, and if no line in front of all beams fits. Equal bytes for both values of `isa`.
std::optional<BeamLine> fit_beam_line(std::span<const BeamReading> readings, const ReadingNoise& noise,
                                      const std::optional<Vec2>& start = {}, Isa isa = best_isa());

/// Covariance of (offset along the canonical normal at `point`, which is on the line [m]; angle, counter-clockwise
/// [rad]).
Eigen::Matrix2d line_covariance(const BeamLine& line, const Vec2& point);

}  // namespace scanbench::extract
