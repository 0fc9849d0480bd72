// Computes the beams of a tilted scanning plane: rotates them in space and projects them on the floor.
#include "sim/tilt.hpp"

#include <cmath>
#include <limits>

#include "core/geometry/portable_math.hpp"
#include "core/rng.hpp"

namespace scanbench::sim {

TiltAngles tilt_angles(const Tilt& tilt, std::uint64_t seed, std::uint32_t frame) {
  CounterRng rng(seed, RngStream::tilt, frame);
  const double roll = rng.normal();
  const double pitch = rng.normal();
  return {tilt.roll_sigma_rad * roll, tilt.pitch_sigma_rad * pitch};
}

double TiltedBeam::range_to_floor(double height_m) const {
  return height_m > 0 && up < 0 ? height_m / -up : std::numeric_limits<double>::infinity();
}

TiltRotation::TiltRotation(const TiltAngles& angles) {
  const auto roll = portable::sincos(angles.roll_rad);
  const auto pitch = portable::sincos(angles.pitch_rad);
  sin_roll_ = roll.sin;
  cos_roll_ = roll.cos;
  sin_pitch_ = pitch.sin;
  cos_pitch_ = pitch.cos;
}

TiltedBeam TiltRotation::beam(const Vec2& direction) const {
  // Ry(pitch) Rx(roll) (x, y, 0)
  const Vec2 above(cos_pitch_ * direction.x() + sin_pitch_ * sin_roll_ * direction.y(), cos_roll_ * direction.y());
  const double up = cos_pitch_ * sin_roll_ * direction.y() - sin_pitch_ * direction.x();
  const double horizontal = std::sqrt(above.x() * above.x() + above.y() * above.y());
  const Vec2 unit = above / horizontal;
  return {{direction.dot(unit), cross(direction, unit)}, horizontal, up};
}

}  // namespace scanbench::sim
