// Box2D's broad phase says which surfaces, double arithmetic says which of them and how far.
#include "sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <box2d/b2_body.h>
#include <box2d/b2_broad_phase.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_contact_manager.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include "core/error.hpp"
#include "sim/ray_math.hpp"

namespace scanbench::sim {
namespace {

// Surfaces closer together than this along a ray count as one place.
constexpr double kTieM = 1e-9;
// Box2D's edges reach this far beyond the walls' ends: its floats leave gaps at shared corners.
constexpr double kEdgeExtensionM = 1e-4;

struct PlacedCircle {
  Vec2 center;
  double radius_m;
};

b2Vec2 to_box2d(const Vec2& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

// The nearest surface so far. Independent of the order of arrival: nearest, then lowest index.
struct Nearest {
  double range = kNoHit;
  std::int32_t surface = -1;

  void offer(double r, std::int32_t s) {
    if (r == kNoHit || r > range + kTieM) return;
    surface = r < range - kTieM ? s : std::min(s, surface);
    range = std::min(r, range);
  }
};

}  // namespace

struct RayCaster::Impl {
  std::vector<Segment> walls;
  std::vector<PlacedCircle> circles;
  std::vector<MovingBody> moving;
  Vec2 origin;         ///< of Box2D's floats: the middle of the world
  double reach = 0.0;  ///< farthest corner of the static world from there
  b2World box2d{b2Vec2(0.0F, 0.0F)};

  explicit Impl(const World& world) : moving(world.moving), origin(center(world)) {
    const b2BodyDef definition;  // one static body for all: a body per wall costs time and gives nothing
    b2Body& body = *box2d.CreateBody(&definition);
    walls.reserve(world.walls.size());
    for (const Wall& wall : world.walls) {
      const Segment& s = wall.segment;
      const Vec2 extension = kEdgeExtensionM * s.direction();
      b2EdgeShape edge;
      edge.SetTwoSided(to_box2d(s.a - extension - origin), to_box2d(s.b + extension - origin));
      add(body, edge);
      walls.push_back(s);
      reach = std::max({reach, (s.a - origin).norm(), (s.b - origin).norm()});
    }
    for (const Circle& circle : world.circles) {
      b2CircleShape shape;
      shape.m_p = to_box2d(circle.center - origin);
      shape.m_radius = static_cast<float>(circle.radius_m);
      add(body, shape);
      circles.push_back({circle.center, circle.radius_m});
      reach = std::max(reach, (circle.center - origin).norm() + circle.radius_m);
    }
  }

  void add(b2Body& body, const b2Shape& shape) const {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = walls.size() + circles.size();
    body.CreateFixture(&fixture);
  }

  // A surface of the static world.
  double range_to(const Ray& ray, std::size_t surface) const {
    if (surface < walls.size()) return range_to_wall(ray.origin, ray.direction, walls[surface]);
    const PlacedCircle& circle = circles[surface - walls.size()];
    return range_to_circle(ray.origin, ray.direction, circle.center, circle.radius_m);
  }

  // The callback of Box2D's tree. The boxes in it are 0.1 m larger than the shapes on all sides, far more than floats
  // err anywhere in a world that validate() accepts, so no surface that the ray meets is left out.
  struct Query {
    const Impl& world;
    const b2BroadPhase& broad_phase;
    const Ray& ray;
    double begin = 0.0;
    double length = 0.0;
    Nearest nearest = {};

    float RayCastCallback(const b2RayCastInput& input, int32 proxy_id) {
      const auto* proxy = static_cast<const b2FixtureProxy*>(broad_phase.GetUserData(proxy_id));
      const auto surface = static_cast<std::size_t>(proxy->fixture->GetUserData().pointer);
      nearest.offer(world.range_to(ray, surface), static_cast<std::int32_t>(surface));
      // Clip the ray behind the nearest hit. Never to 0, which would end the search before ties are seen.
      const double fraction = std::max(nearest.range - begin, 0.01) / length;
      return fraction < input.maxFraction ? static_cast<float>(fraction) : input.maxFraction;
    }
  };

  RayHit cast(const Ray& ray, double range_max_m, std::span<const PlacedCircle> moved) const {
    Nearest nearest;
    // Box2D gets the part of the ray in the disc around the static world: its floats are never asked about places far
    // from its origin, however far away the sensor stands and however far it sees.
    const Vec2 local = ray.origin - origin;
    const double disc = reach + 1.0;
    const double abeam = -ray.direction.dot(local);
    const double begin = std::max(0.0, abeam - disc);
    const double end = std::min(range_max_m, abeam + disc);
    if (std::fabs(cross(ray.direction, local)) <= disc && begin <= end) {
      const double length = std::max(end - begin, 1.0);
      b2RayCastInput input;
      input.p1 = to_box2d(local + begin * ray.direction);
      input.p2 = to_box2d(local + (begin + length) * ray.direction);
      input.maxFraction = 1.0F;
      const b2BroadPhase& broad_phase = box2d.GetContactManager().m_broadPhase;
      Query query{*this, broad_phase, ray, begin, length, {}};
      broad_phase.RayCast(&query, input);
      nearest = query.nearest;
    }
    const std::size_t first_moving = walls.size() + circles.size();
    for (std::size_t i = 0; i < moved.size(); ++i)
      nearest.offer(range_to_circle(ray.origin, ray.direction, moved[i].center, moved[i].radius_m),
                    static_cast<std::int32_t>(first_moving + i));
    return finish(ray, range_max_m, nearest, moved);
  }

  RayHit finish(const Ray& ray, double range_max_m, const Nearest& nearest, std::span<const PlacedCircle> moved) const {
    RayHit hit;
    if (nearest.surface < 0 || nearest.range > range_max_m) return hit;
    hit.range_m = nearest.range;
    hit.surface = nearest.surface;
    const auto surface = static_cast<std::size_t>(nearest.surface);
    if (surface < walls.size()) {
      hit.wall = nearest.surface;
      hit.cos_incidence = cos_incidence_on_wall(ray.direction, walls[surface]);
    } else {
      const std::size_t i = surface - walls.size();
      const PlacedCircle& circle = i < circles.size() ? circles[i] : moved[i - circles.size()];
      hit.cos_incidence = cos_incidence_on_circle(ray.origin, ray.direction, circle.center, circle.radius_m);
    }
    return hit;
  }

  void place_moving(double time_s, std::vector<PlacedCircle>& moved) const {
    moved.clear();
    for (const MovingBody& body : moving) moved.push_back({body.position(time_s), body.radius_m});
  }
};

RayCaster::RayCaster(const World& world) {
  validate(world);
  impl_ = std::make_unique<Impl>(world);
}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

namespace {

void store(const RayHit& hit, std::size_t i, const HitBuffers& out) {
  if (!out.ranges.empty()) out.ranges[i] = hit.range_m;
  if (!out.wall_ids.empty()) out.wall_ids[i] = hit.wall;
  if (!out.cos_incidence.empty()) out.cos_incidence[i] = hit.cos_incidence;
}

void check_sizes(const HitBuffers& out, std::size_t count) {
  SCANBENCH_ASSERT(out.ranges.empty() || out.ranges.size() == count);
  SCANBENCH_ASSERT(out.wall_ids.empty() || out.wall_ids.size() == count);
  SCANBENCH_ASSERT(out.cos_incidence.empty() || out.cos_incidence.size() == count);
}

}  // namespace

RayHit RayCaster::cast(const Ray& ray, double range_max_m) const {
  std::vector<PlacedCircle> moved;
  impl_->place_moving(ray.time_s, moved);
  return impl_->cast(ray, range_max_m, moved);
}

void RayCaster::cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s,
                           const ScanGeometry& beams, double range_max_m, const HitBuffers& out) const {
  const auto n = static_cast<std::size_t>(beams.beams());
  check_sizes(out, world_from_sensor.size() * n);
  SCANBENCH_ASSERT(stamps_s.empty() || stamps_s.size() == world_from_sensor.size());
  std::vector<PlacedCircle> moved;
  for (std::size_t k = 0; k < world_from_sensor.size(); ++k) {
    const Pose2& pose = world_from_sensor[k];
    const double time_s = stamps_s.empty() ? 0.0 : stamps_s[k];
    impl_->place_moving(time_s, moved);
    for (std::size_t i = 0; i < n; ++i) {
      const Ray ray{pose.translation(), pose.rotate(beams.direction(static_cast<int>(i))), time_s};
      store(impl_->cast(ray, range_max_m, moved), k * n + i, out);
    }
  }
}

void RayCaster::cast_rays(std::span<const Ray> rays, double range_max_m, const HitBuffers& out) const {
  check_sizes(out, rays.size());
  std::vector<PlacedCircle> moved;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!impl_->moving.empty()) impl_->place_moving(rays[i].time_s, moved);
    store(impl_->cast(rays[i], range_max_m, moved), i, out);
  }
}

}  // namespace scanbench::sim
