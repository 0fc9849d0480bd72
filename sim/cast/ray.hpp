// Rays, their hits, and the buffers for many hits.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::sim {

/// World frame; `direction` is a unit vector. The time places moving bodies.
struct Ray {
  Vec2 origin = Vec2::Zero();
  Vec2 direction{1.0, 0.0};
  double time_s = 0.0;
};

/// The first surface on a ray.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();  ///< +inf: nothing within the largest range
  std::int32_t wall = -1;                                    ///< index into World::walls; -1: nothing, or a round body
  std::int32_t surface = -1;   ///< index over walls, then circles, then moving bodies; -1: nothing
  double cos_incidence = 0.0;  ///< |cos| of the angle to the surface's normal; 0 without a hit
};

/// Buffers for hits, one number per ray. An empty span is not filled.
struct HitBuffers {
  std::span<double> ranges;
  std::span<std::int32_t> wall_ids;
  std::span<double> cos_incidence;
  std::span<std::int32_t> surfaces = {};
};

/// Beams of a scan taken in an instant that do not point where the data sheet says: tilted, jittered or deflected.
/// Beam i of `directions` (unit vectors, world frame) belongs near beam i of the sensor; the farther it is from there,
/// the longer casting takes.
struct BentScan {
  Pose2 world_from_sensor;
  double stamp_s = 0.0;
  std::span<const Vec2> directions;
};

}  // namespace scanbench::sim
