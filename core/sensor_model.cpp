// The table of beam directions and the standard deviations of readings.
#include "core/sensor_model.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/geometry/portable_math.hpp"

namespace scanbench {

ScanGeometry::ScanGeometry(double angle_min_rad, double angle_step_rad, int beams)
    : angle_min_(angle_min_rad), angle_step_(angle_step_rad) {
  if (beams < 0) throw ParamError("beams", "beams is " + std::to_string(beams) + "; it must not be negative");
  if (!std::isfinite(angle_min_rad) || !std::isfinite(angle_step_rad))
    throw ParamError("angle_min", "beam angles must be finite");
  directions_.reserve(as_index(beams));
  for (int i = 0; i < beams; ++i) {
    const auto [s, c] = portable::sincos(angle(i));
    directions_.emplace_back(c, s);
  }
}

double SensorNoise::gaussian_sigma(double range_m) const {
  const double proportional = sigma_relative * range_m;
  if (relative_from_m > 0) return range_m < relative_from_m ? sigma_m : proportional;
  return std::sqrt(sigma_m * sigma_m + proportional * proportional);
}

double SensorNoise::range_sigma(double range_m) const {
  const double g = gaussian_sigma(range_m);
  return std::sqrt(g * g + quantum_m * quantum_m / 12.0);
}

}  // namespace scanbench
