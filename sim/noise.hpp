// What a range sensor makes of a true range. Each part has draws of its own, addressed by (seed, frame, beam): the same
// for any number of threads, and switching one part on does not move the others.
#pragma once

#include <cstdint>
#include <optional>

#include "core/sensor_model.hpp"

namespace scanbench::sim {

/// Which reading of which recording a draw belongs to.
struct BeamAddress {
  std::uint64_t seed = 1;
  std::uint32_t frame = 0;
  std::uint32_t beam = 0;
};

/// The unit vector v turned by an angle.
Vec2 turned(const Vec2& v, double angle_rad);

/// The angle by which a beam really points beside its nominal direction. 0 without bearing noise.
double bearing_error(const SensorNoise& noise, const BeamAddress& address);

/// The range that a beam of finite width returns at a depth edge: when its two sides meet different surfaces whose
/// ranges differ by more than the beam is wide there. Uniform between the two ranges, for where in the beam the edge
/// lies is chance.
double mixed_range(double range_a_m, double range_b_m, const BeamAddress& address);

/// The reading of a beam whose light meets something at `true_range_m` (finite or +inf, never negative) under an angle
/// with cosine `cos_incidence` to its normal. In this order:
///   nothing within range_max: +inf, no noise; nearer than range_min: -inf;
///   drop-out, with probability min(1, dropout_probability + dropout_grazing (1 - cos)^2): +inf;
///   short return, with spurious_probability: the range becomes uniform between range_min and the true one;
///   gaussian error with SensorNoise::gaussian_sigma of that range; rounding to multiples of the quantum;
///   a reading below range_min or not positive: -inf, above range_max: +inf (REP-117).
double observed_range(const SensorModel& sensor, double true_range_m, double cos_incidence, const BeamAddress& address);

}  // namespace scanbench::sim
