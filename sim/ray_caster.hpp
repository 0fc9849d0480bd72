// Exact ranges of a world, a batch at a time. Memory is the caller's; nothing is allocated per ray.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "core/geometry.hpp"
#include "core/pose2.hpp"
#include "core/sensor_model.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// World frame; `direction` is a unit vector. The time places moving bodies.
struct Ray {
  Vec2 origin = Vec2::Zero();
  Vec2 direction{1.0, 0.0};
  double time_s = 0.0;
};

/// What a ray meets first.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();  ///< +inf: nothing within the largest range
  std::int32_t wall = -1;                                    ///< index into World::walls; -1: nothing, or a round body
  std::int32_t surface = -1;   ///< walls, then circles, then moving bodies, counted through; -1: nothing
  double cos_incidence = 0.0;  ///< |cos| of the angle to the surface's normal; 0 without a hit
};

/// Where the answers go: one number per ray. An empty span is not wanted.
struct HitBuffers {
  std::span<double> ranges;
  std::span<std::int32_t> wall_ids;
  std::span<double> cos_incidence;
};

/// A frozen world that answers rays; const calls may come from many threads at once.
///
/// Box2D's broad phase names the surfaces near a ray; double arithmetic says which is hit and how far
/// (sim/ray_math.hpp). Box2D's own narrow phase is not asked, since its floats lose grazing rays and take the wrong one
/// of two walls at nearly one distance. Of surfaces within 1e-9 m of the nearest the lowest index wins (walls that
/// overlap, corners).
class RayCaster {
 public:
  /// Copies what it needs. Throws what validate() throws.
  explicit RayCaster(const World& world);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// One ray. Surfaces beyond `range_max_m` are nothing.
  RayHit cast(const Ray& ray, double range_max_m) const;

  /// Whole scans that are taken in an instant: poses x beams, row-major. `stamps_s`: one time per pose, or empty for 0.
  /// Every buffer that is wanted has poses x beams places, else InternalError.
  void cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s, const ScanGeometry& beams,
                  double range_max_m, const HitBuffers& out) const;

  /// Rays each from its own place and time, as a scan that is swept while the sensor moves has them.
  void cast_rays(std::span<const Ray> rays, double range_max_m, const HitBuffers& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scanbench::sim
