// The interface of the casters, which cast rays in a fixed world. Const calls may come from several threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensor_model.hpp"
#include "sim/cast/ray.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// A round body at a place.
struct PlacedCircle {
  Vec2 center;
  double radius_m;
};

/// The surfaces of a world, indexed: walls, then circles, then moving bodies.
struct Surfaces {
  std::vector<Segment> walls;
  std::vector<PlacedCircle> circles;
  std::vector<MovingBody> moving;

  explicit Surfaces(const World& world);
  /// The moving bodies at a time.
  std::vector<PlacedCircle> placed(double time_s) const;
  /// The hit of a ray whose nearest surface is known; no hit if it is -1 or beyond `range_max_m`. `moved`: placed() at
  /// the ray's time.
  RayHit hit(const Vec2& origin, const Vec2& direction, double range_m, std::int32_t surface, double range_max_m,
             std::span<const PlacedCircle> moved) const;
};

/// All casters give the same range to the last bit for the same surface, and the lowest index of the surfaces within
/// 1e-9 m of the nearest. Buffers have one element per ray, or none.
class Caster {
 public:
  virtual ~Caster() = default;
  virtual RayHit cast(const Ray& ray, double range_max_m) const = 0;
  /// Scans of the sensor's own beams, each taken in an instant. `stamps_s`: one per pose, or empty for 0.
  virtual void cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s,
                          const ScanGeometry& beams, double range_max_m, const HitBuffers& out) const = 0;
  /// One scan with directions of its own.
  virtual void cast_bent_scan(const BentScan& scan, const ScanGeometry& beams, double range_max_m,
                              const HitBuffers& out) const = 0;
};

/// Writes one hit.
void store_hit(const RayHit& hit, std::size_t i, const HitBuffers& out);

}  // namespace scanbench::sim
