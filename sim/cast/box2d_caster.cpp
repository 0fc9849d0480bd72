// Casts rays with Box2D's broad phase.
#include "sim/cast/box2d_caster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <box2d/b2_body.h>
#include <box2d/b2_broad_phase.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_contact_manager.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensor_model.hpp"
#include "sim/ray_math.hpp"

namespace scanbench::sim {
namespace {

// Surfaces closer together than this along a ray count as one place.
constexpr double kTreeTieM = 1e-9;
// Box2D's edges reach this far beyond the walls' ends: its floats leave gaps at shared corners.
constexpr double kEdgeExtensionM = 1e-4;

b2Vec2 to_box2d(const Vec2& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

// The nearest surface so far: smallest range, then lowest index.
struct Nearest {
  double range = kNoHit;
  std::int32_t surface = -1;

  void offer(double r, std::int32_t s) {
    if (r == kNoHit || r > range + kTreeTieM) return;
    surface = r < range - kTreeTieM ? s : std::min(s, surface);
    range = std::min(r, range);
  }
};

class Box2DCaster : public Caster {
 public:
  explicit Box2DCaster(const World& world) : surfaces_(world), origin_(center(world)) {
    const b2BodyDef definition;  // one static body for all, because a body per wall only costs time
    b2Body& body = *box2d_.CreateBody(&definition);
    for (const Wall& wall : world.walls) {
      const Segment& s = wall.segment;
      const Vec2 extension = kEdgeExtensionM * s.direction();
      b2EdgeShape edge;
      edge.SetTwoSided(to_box2d(s.a - extension - origin_), to_box2d(s.b + extension - origin_));
      add(body, edge);
      reach_ = std::max({reach_, (s.a - origin_).norm(), (s.b - origin_).norm()});
    }
    for (const Circle& circle : world.circles) {
      b2CircleShape shape;
      shape.m_p = to_box2d(circle.center - origin_);
      shape.m_radius = static_cast<float>(circle.radius_m);
      add(body, shape);
      reach_ = std::max(reach_, (circle.center - origin_).norm() + circle.radius_m);
    }
  }

  RayHit cast(const Ray& ray, double range_max_m) const override {
    return cast(ray, range_max_m, surfaces_.placed(ray.time_s));
  }

  void cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s, const ScanGeometry& beams,
                  double range_max_m, const HitBuffers& out) const override {
    std::size_t at = 0;
    for (std::size_t k = 0; k < world_from_sensor.size(); ++k) {
      const Pose2& pose = world_from_sensor[k];
      const std::vector<PlacedCircle> moved = surfaces_.placed(stamps_s.empty() ? 0.0 : stamps_s[k]);
      for (int i = 0; i < beams.beams(); ++i, ++at)
        store_hit(cast({pose.translation(), pose.rotate(beams.direction(i)), 0.0}, range_max_m, moved), at, out);
    }
  }

  void cast_bent_scan(const BentScan& scan, const ScanGeometry& /*beams*/, double range_max_m,
                      const HitBuffers& out) const override {
    const std::vector<PlacedCircle> moved = surfaces_.placed(scan.stamp_s);
    for (std::size_t i = 0; i < scan.directions.size(); ++i)
      store_hit(cast({scan.world_from_sensor.translation(), scan.directions[i], 0.0}, range_max_m, moved), i, out);
  }

 private:
  RayHit cast(const Ray& ray, double range_max_m, std::span<const PlacedCircle> moved) const {
    Nearest nearest;
    // Box2D gets only the part of the ray in the disc around the static world, so that its floats stay near its origin
    // for every distance of the sensor and every range.
    const Vec2 local = ray.origin - origin_;
    const double disc = reach_ + 1.0;
    const double abeam = -ray.direction.dot(local);
    const double begin = std::max(0.0, abeam - disc);
    const double end = std::min(range_max_m, abeam + disc);
    if (std::fabs(cross(ray.direction, local)) <= disc && begin <= end) {
      const double length = std::max(end - begin, 1.0);
      b2RayCastInput input;
      input.p1 = to_box2d(local + begin * ray.direction);
      input.p2 = to_box2d(local + (begin + length) * ray.direction);
      input.maxFraction = 1.0F;
      const b2BroadPhase& broad_phase = box2d_.GetContactManager().m_broadPhase;
      Query query{*this, broad_phase, ray, begin, length, {}};
      broad_phase.RayCast(&query, input);
      nearest = query.nearest;
    }
    const std::size_t first_moving = surfaces_.walls.size() + surfaces_.circles.size();
    for (std::size_t i = 0; i < moved.size(); ++i)
      nearest.offer(range_to_circle(ray.origin, ray.direction, moved[i].center, moved[i].radius_m),
                    static_cast<std::int32_t>(first_moving + i));
    return surfaces_.hit(ray.origin, ray.direction, nearest.range, nearest.surface, range_max_m, moved);
  }

  // Surfaces are added in the order of their indices.
  void add(b2Body& body, const b2Shape& shape) {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = added_++;
    body.CreateFixture(&fixture);
  }

  double range_to(const Ray& ray, std::size_t surface) const {
    if (surface < surfaces_.walls.size()) return range_to_wall(ray.origin, ray.direction, surfaces_.walls[surface]);
    const PlacedCircle& circle = surfaces_.circles[surface - surfaces_.walls.size()];
    return range_to_circle(ray.origin, ray.direction, circle.center, circle.radius_m);
  }

  // The callback of Box2D's tree. Its boxes are 0.1 m larger than the shapes on all sides, far more than the errors of
  // floats anywhere in a world that validate() accepts, so no surface on the ray is left out.
  struct Query {
    const Box2DCaster& world;
    const b2BroadPhase& broad_phase;
    const Ray& ray;
    double begin = 0.0;
    double length = 0.0;
    Nearest nearest = {};

    float RayCastCallback(const b2RayCastInput& input, int32 proxy_id) {
      const auto* proxy = static_cast<const b2FixtureProxy*>(broad_phase.GetUserData(proxy_id));
      const auto surface = static_cast<std::size_t>(proxy->fixture->GetUserData().pointer);
      nearest.offer(world.range_to(ray, surface), static_cast<std::int32_t>(surface));
      // Clips the ray behind the nearest hit, but never to 0, which would end the search before ties are found.
      const double fraction = std::max(nearest.range - begin, 0.01) / length;
      return fraction < input.maxFraction ? static_cast<float>(fraction) : input.maxFraction;
    }
  };

  Surfaces surfaces_;
  std::size_t added_ = 0;
  Vec2 origin_;         ///< origin of Box2D's floats: the middle of the world
  double reach_ = 0.0;  ///< farthest corner of the static world from there
  b2World box2d_{b2Vec2(0.0F, 0.0F)};
};

}  // namespace

std::unique_ptr<Caster> make_box2d_caster(const World& world) {
  return std::make_unique<Box2DCaster>(world);
}

}  // namespace scanbench::sim
