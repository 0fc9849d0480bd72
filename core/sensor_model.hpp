// The data sheet of a 2D laser scanner: beam angles, range limits, noise. Algorithms may read all of it.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/index.hpp"

namespace scanbench {

/// Beam i points to angle_min + i * angle_step in the sensor frame (x forward, y left), i = 0 .. beams-1.
class ScanGeometry {
 public:
  ScanGeometry() = default;
  /// Radians; angle_step may be negative (clockwise scanners). Throws ParamError for beams < 0 or non-finite angles.
  ScanGeometry(double angle_min_rad, double angle_step_rad, int beams);

  int beams() const { return static_cast<int>(directions_.size()); }
  double angle_min() const { return angle_min_; }
  double angle_step() const { return angle_step_; }
  double angle(int beam) const { return angle_min_ + beam * angle_step_; }
  /// Unit vector of a beam, from a table made by the constructor.
  const Vec2& direction(int beam) const { return directions_[as_index(beam)]; }

 private:
  double angle_min_ = 0.0;
  double angle_step_ = 0.0;
  std::vector<Vec2> directions_;
};

/// Noise of a range sensor. A sigma is one standard deviation; all parts are independent and act together.
struct SensorNoise {
  double sigma_m = 0.0;         ///< constant part of the range's standard deviation
  double sigma_relative = 0.0;  ///< part proportional to range
  double relative_from_m =
      0.0;  ///< 0: both parts add in quadrature; > 0: constant below this range, proportional beyond
  double bearing_sigma_rad = 0.0;     ///< of the beam's true direction about its nominal one
  double quantum_m = 0.0;             ///< rounding step of ranges; 0 disables rounding
  double dropout_probability = 0.0;   ///< for a beam that hits, at normal incidence
  double dropout_grazing = 0.0;       ///< added at grazing incidence; grows as (1 - cos(incidence))^2
  double spurious_probability = 0.0;  ///< of a false return, uniform between range_min and the true range
  double beam_divergence_rad = 0.0;   ///< full opening angle; > 0 gives mixed pixels at depth edges

  /// Standard deviation of a reading at this true range, without quantisation.
  double gaussian_sigma(double range_m) const;
  /// Standard deviation of a reading at this true range, rounding (quantum^2 / 12) included.
  double range_sigma(double range_m) const;
};

struct SensorModel {
  std::string name;
  std::string source;  ///< where the values come from
  ScanGeometry geometry;
  double range_min_m = 0.0;
  double range_max_m = 30.0;
  double time_per_beam_s = 0.0;
  double scan_period_s = 0.1;  ///< between the first beams of two scans
  SensorNoise noise;
};

}  // namespace scanbench
