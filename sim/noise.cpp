// Noise of a range sensor, one beam at a time.
#include "sim/noise.hpp"

#include <cmath>
#include <limits>

#include "core/geometry.hpp"
#include "core/portable_math.hpp"
#include "core/rng.hpp"

namespace scanbench::sim {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

CounterRng draws(const BeamAddress& address, RngStream stream) {
  return {address.seed, stream, address.frame, address.beam};
}

}  // namespace

Vec2 rotated(const Vec2& v, double angle_rad) {
  const auto [s, c] = portable::sincos(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

double bearing_error(const SensorNoise& noise, const BeamAddress& address) {
  if (!(noise.bearing_sigma_rad > 0)) return 0.0;
  return noise.bearing_sigma_rad * draws(address, RngStream::bearing).normal();
}

double mixed_range(double range_a_m, double range_b_m, const BeamAddress& address) {
  return range_a_m + draws(address, RngStream::mixed_pixel).uniform() * (range_b_m - range_a_m);
}

double observed_range(const SensorModel& sensor, double true_range_m, double cos_incidence,
                      const BeamAddress& address) {
  const SensorNoise& noise = sensor.noise;
  double range = true_range_m;
  if (!(range <= sensor.range_max_m)) return kInf;
  if (range < sensor.range_min_m) return -kInf;
  if (noise.dropout_probability > 0 || noise.dropout_grazing > 0) {
    const double slant = 1.0 - cos_incidence;
    const double probability = noise.dropout_probability + noise.dropout_grazing * slant * slant;
    if (draws(address, RngStream::dropout).uniform() < probability) return kInf;
  }
  if (noise.spurious_probability > 0) {
    CounterRng spurious = draws(address, RngStream::spurious);
    if (spurious.uniform() < noise.spurious_probability)
      range = sensor.range_min_m + spurious.uniform() * (range - sensor.range_min_m);
  }
  const double sigma = noise.gaussian_sigma(range);
  if (sigma > 0) range += sigma * draws(address, RngStream::range).normal();
  if (noise.quantum_m > 0) range = std::floor(range / noise.quantum_m + 0.5) * noise.quantum_m;
  if (range < sensor.range_min_m || range <= 0) return -kInf;
  return range <= sensor.range_max_m ? range : kInf;
}

}  // namespace scanbench::sim
