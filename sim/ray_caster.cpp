// Chooses the caster, and checks the buffers of its callers.
#include "sim/ray_caster.hpp"

#include <cstddef>

#include "core/error.hpp"
#include "sim/cast/box2d_caster.hpp"
#include "sim/cast/exact_caster.hpp"

namespace scanbench::sim {
namespace {

void check_sizes(const HitBuffers& out, std::size_t count) {
  SCANBENCH_ASSERT(out.ranges.empty() || out.ranges.size() == count);
  SCANBENCH_ASSERT(out.wall_ids.empty() || out.wall_ids.size() == count);
  SCANBENCH_ASSERT(out.cos_incidence.empty() || out.cos_incidence.size() == count);
  SCANBENCH_ASSERT(out.surfaces.empty() || out.surfaces.size() == count);
}

}  // namespace

RayCaster::RayCaster(const World& world, CasterKind kind, Isa isa) {
  validate(world);
  caster_ = kind == CasterKind::box2d ? make_box2d_caster(world) : make_exact_caster(world, isa);
}

RayHit RayCaster::cast(const Ray& ray, double range_max_m) const {
  return caster_->cast(ray, range_max_m);
}

void RayCaster::cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s,
                           const ScanGeometry& beams, double range_max_m, const HitBuffers& out) const {
  check_sizes(out, world_from_sensor.size() * static_cast<std::size_t>(beams.beams()));
  SCANBENCH_ASSERT(stamps_s.empty() || stamps_s.size() == world_from_sensor.size());
  caster_->cast_scans(world_from_sensor, stamps_s, beams, range_max_m, out);
}

void RayCaster::cast_bent_scan(const BentScan& scan, const ScanGeometry& beams, double range_max_m,
                               const HitBuffers& out) const {
  check_sizes(out, static_cast<std::size_t>(beams.beams()));
  SCANBENCH_ASSERT(scan.directions.size() == static_cast<std::size_t>(beams.beams()));
  caster_->cast_bent_scan(scan, beams, range_max_m, out);
}

void RayCaster::cast_rays(std::span<const Ray> rays, double range_max_m, const HitBuffers& out) const {
  check_sizes(out, rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) store_hit(cast(rays[i], range_max_m), i, out);
}

}  // namespace scanbench::sim
