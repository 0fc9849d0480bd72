// Shared parts of the casters: places moving bodies and describes the hit on a known surface.
#include "sim/cast/caster.hpp"

#include <cstddef>

#include "sim/ray_math.hpp"

namespace scanbench::sim {

Surfaces::Surfaces(const World& world) : moving(world.moving) {
  for (const Wall& wall : world.walls) walls.push_back(wall.segment);
  for (const Circle& circle : world.circles) circles.push_back({circle.center, circle.radius_m});
}

std::vector<PlacedCircle> Surfaces::placed(double time_s) const {
  std::vector<PlacedCircle> bodies;
  for (const MovingBody& body : moving) bodies.push_back({body.position(time_s), body.radius_m});
  return bodies;
}

RayHit Surfaces::hit(const Vec2& origin, const Vec2& direction, double range_m, std::int32_t surface,
                     double range_max_m, std::span<const PlacedCircle> moved) const {
  RayHit hit;
  if (surface < 0 || range_m > range_max_m) return hit;
  hit.range_m = range_m;
  hit.surface = surface;
  const auto s = static_cast<std::size_t>(surface);
  if (s < walls.size()) {
    hit.wall = surface;
    hit.cos_incidence = cos_incidence_on_wall(direction, walls[s]);
  } else {
    const std::size_t i = s - walls.size();
    const PlacedCircle& circle = i < circles.size() ? circles[i] : moved[i - circles.size()];
    hit.cos_incidence = cos_incidence_on_circle(origin, direction, circle.center, circle.radius_m);
  }
  return hit;
}

void store_hit(const RayHit& hit, std::size_t i, const HitBuffers& out) {
  if (!out.ranges.empty()) out.ranges[i] = hit.range_m;
  if (!out.wall_ids.empty()) out.wall_ids[i] = hit.wall;
  if (!out.cos_incidence.empty()) out.cos_incidence[i] = hit.cos_incidence;
  if (!out.surfaces.empty()) out.surfaces[i] = hit.surface;
}

}  // namespace scanbench::sim
