// Casts rays in batches and gives exact ranges. The caller owns the memory; nothing is allocated per ray.
#pragma once

#include <memory>
#include <span>

#include "core/geometry/pose2.hpp"
#include "core/isa.hpp"
#include "core/sensor_model.hpp"
#include "sim/cast/caster.hpp"
#include "sim/cast/ray.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// The algorithm of ray casting. Both give the same bytes, but not in the same time.
enum class CasterKind {
  exact,  ///< fast: sweeps walls over the beams of a scan
  box2d,  ///< the reference: Box2D's broad phase, one ray at a time
};

/// Casts rays in a fixed world; const calls may come from several threads at once.
///
/// Double arithmetic decides which surface is hit and at what range (sim/wall_range.hpp). Of surfaces within 1e-9 m of
/// the nearest the lowest index wins (walls that overlap, corners).
class RayCaster {
 public:
  /// Copies what it needs. Throws what validate() throws. `isa` is for tests.
  explicit RayCaster(const World& world, CasterKind kind = CasterKind::exact, Isa isa = best_isa());

  /// One ray. Surfaces beyond `range_max_m` are ignored.
  RayHit cast(const Ray& ray, double range_max_m) const;

  /// Whole scans, each taken in an instant: poses x beams, row-major. `stamps_s`: one time per pose, or empty for 0. A
  /// buffer has poses x beams elements or none, else InternalError.
  void cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s, const ScanGeometry& beams,
                  double range_max_m, const HitBuffers& out) const;

  /// One scan whose beams do not point where the data sheet says. A buffer has one element per beam or none, and
  /// `scan.directions` has one per beam, else InternalError.
  void cast_bent_scan(const BentScan& scan, const ScanGeometry& beams, double range_max_m, const HitBuffers& out) const;

  /// Rays that each have their own origin and time, for a scan that is swept while the sensor moves.
  void cast_rays(std::span<const Ray> rays, double range_max_m, const HitBuffers& out) const;

 private:
  std::unique_ptr<const Caster> caster_;
};

}  // namespace scanbench::sim
