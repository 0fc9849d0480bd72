// Compares casting and simulating with named alternatives and prints rows of bench/ratios.hpp.
//
//   sim_bench [rounds] [SUBJECT]     default: 11 rounds of all subjects; SUBJECT: only those whose name begins so
//
// A scan has 451 beams over 270 deg and a range of 30 m. Each world is scanned from 200 poses.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <box2d/b2_body.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>
#include <box2d/b2_world_callbacks.h>

#include "bench/ratios.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/params.hpp"
#include "core/recording.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "core/truth.hpp"
#include "sim/noise.hpp"
#include "sim/odometry.hpp"
#include "sim/ray_caster.hpp"
#include "sim/sensors.hpp"
#include "sim/simulate.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::sim {
namespace {

constexpr std::size_t kPoses = 200;

void add(World& world, const Vec2& a, const Vec2& b) {
  world.walls.push_back({std::to_string(world.walls.size() + 1), {a, b}});
}

World fifteen_walls() {
  World world;
  world.name = "15 walls";
  const double rows[15][4] = {{1.55, 0.75, 1.55, 1.65},    {1.95, 2.20, 2.45, 3.25},  {1.25, 11.25, 1.80, 11.25},
                              {1.55, 0.75, 1.55, 3.90},    {2.75, 0.00, 2.75, 0.45},  {9.75, 7.45, 9.75, 11.40},
                              {2.70, 10.00, 3.35, 10.00},  {0.00, 2.35, 0.00, 5.90},  {2.85, 5.15, 1.55, 3.75},
                              {11.15, 13.35, 13.5, 13.35}, {9.70, 7.40, 10.35, 7.40}, {1.90, 10.90, 2.50, 10.90},
                              {1.55, 10.90, 5.90, 10.90},  {3.20, 0.95, 3.20, 2.05},  {3.30, 9.90, 4.05, 9.70}};
  for (const auto& r : rows) add(world, {r[0], r[1]}, {r[2], r[3]});
  return world;
}

// `side` x `side` rooms of 6 m x 5 m with doors and a piece of furniture.
World rooms(int side) {
  World world;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2 o(6.0 * i, 5.0 * j);
      add(world, o, o + Vec2(2.5, 0));
      add(world, o + Vec2(3.5, 0), o + Vec2(6, 0));
      add(world, o, o + Vec2(0, 1.7));
      add(world, o + Vec2(0, 2.6), o + Vec2(0, 5));
      add(world, o + Vec2(1.1, 3.3), o + Vec2(2.3, 3.9));
    }
  world.name = "rooms, " + std::to_string(world.walls.size()) + " walls";
  return world;
}

// A cave: one closed outline of short walls around the origin, all of them visible from the centre.
World outline(int corners) {
  World world;
  world.name = "outline, " + std::to_string(corners) + " walls";
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = kTwoPi * i / corners;
    const double radius = 10.0 + 1.5 * std::sin(5.0 * angle) + 0.5 * std::sin(31.0 * angle);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (int i = 0; i < corners; ++i)
    add(world, points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>((i + 1) % corners)]);
  return world;
}

Trajectory drive() {
  const NamedPoints corners{{"A", {6.45, 3.15}}, {"B", {4.60, 1.50}}, {"C", {2.30, 8.15}},
                            {"D", {7.25, 6.00}}, {"E", {5.10, 7.45}}, {"F", {1.35, 7.70}}};
  return Registry<TrajectoryKind>::make("waypoints", {{"points_m", corners}, {"scans", std::int64_t{kPoses}}})
      ->generate(0.1);
}

std::vector<Pose2> driven_poses() {
  std::vector<Pose2> poses;
  for (const TimedPose& pose : drive().poses) poses.push_back(pose.world_from_sensor);
  return poses;
}

std::vector<Pose2> random_poses(const Vec2& low, const Vec2& high) {
  CounterRng rng(1, RngStream::resampling);
  std::vector<Pose2> poses;
  for (std::size_t k = 0; k < kPoses; ++k) {
    const double x = low.x() + rng.uniform() * (high.x() - low.x());
    const double y = low.y() + rng.uniform() * (high.y() - low.y());
    poses.emplace_back(x, y, kTwoPi * rng.uniform());
  }
  return poses;
}

// The named alternative: b2World::RayCast for the closest hit, one static body, a table of beams.
class Box2DRays {
 public:
  explicit Box2DRays(const World& world) {
    const b2BodyDef definition;
    b2Body& body = *world_.CreateBody(&definition);
    for (std::size_t i = 0; i < world.walls.size(); ++i) {
      const Segment& s = world.walls[i].segment;
      b2EdgeShape edge;
      edge.SetTwoSided(point(s.a), point(s.b));
      b2FixtureDef fixture;
      fixture.shape = &edge;
      fixture.userData.pointer = i;
      body.CreateFixture(&fixture);
    }
  }

  void cast(const std::vector<Pose2>& poses, std::size_t every, const SensorModel& sensor, std::vector<double>& ranges,
            std::vector<std::int32_t>& ids) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k < poses.size(); k += every)
      for (int i = 0; i < sensor.geometry.beams(); ++i, ++at) {
        const Vec2 to = poses[k].translation() + sensor.range_max_m * poses[k].rotate(sensor.geometry.direction(i));
        Closest closest;
        world_.RayCast(&closest, point(poses[k].translation()), point(to));
        ranges[at] = closest.id < 0 ? INFINITY : static_cast<double>(closest.fraction) * sensor.range_max_m;
        ids[at] = closest.id;
      }
  }

 private:
  struct Closest : b2RayCastCallback {
    float fraction = 1.0F;
    std::int32_t id = -1;
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float at) override {
      fraction = at;
      id = static_cast<std::int32_t>(fixture->GetUserData().pointer);
      return at;
    }
  };

  static b2Vec2 point(const Vec2& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

  b2World world_{b2Vec2(0.0F, 0.0F)};
};

using bench::measure;
using bench::Method;

// `every`: the alternative casts only from every so many-th pose where it is slow.
void measure_casting(const World& world, const std::vector<Pose2>& poses, std::size_t every, double limit, int rounds) {
  const SensorModel sensor = make_sensor("ladar_2d30", {});
  const auto beams = static_cast<std::size_t>(sensor.geometry.beams());
  std::vector<double> ranges(poses.size() * beams);
  std::vector<std::int32_t> ids(ranges.size());
  const Box2DRays box2d(world);
  const auto caster = [&](const std::string& name, const RayCaster& c, double at_least) {
    const auto run = [&] {
      c.cast_scans(poses, {}, sensor.geometry, sensor.range_max_m, {ranges, ids, {}});
      return ranges.size();
    };
    return Method{name, run, at_least};
  };
  std::vector<Pose2> few;
  for (std::size_t k = 0; k < poses.size(); k += every) few.push_back(poses[k]);
  const RayCaster reference(world, CasterKind::box2d);
  const RayCaster exact(world);
  const RayCaster baseline(world, CasterKind::exact, Isa::baseline);
  measure("cast, " + world.name + ", a beam",
          {{"b2World::RayCast",
            [&] {
              box2d.cast(poses, every, sensor, ranges, ids);
              return few.size() * beams;
            }},
           {"caster: box2d",
            [&] {
              const std::size_t count = few.size() * beams;
              reference.cast_scans(few, {}, sensor.geometry, sensor.range_max_m,
                                   {std::span(ranges).first(count), std::span(ids).first(count), {}});
              return count;
            }},
           caster("caster: exact, any x86-64", baseline, 0),
           caster("caster: exact", exact, limit)},
          rounds);
}

// The former implementation of simulate(), before scans were swept: one ray through the tree of Box2D, then one
// reading, and so on.
std::size_t simulate_one_by_one(const SimulationInput& input) {
  validate(input.world);
  check_clear(input.world, input.trajectory, input.sensor.range_max_m);
  const RayCaster caster(input.world, CasterKind::box2d);
  const auto n = static_cast<std::size_t>(input.sensor.geometry.beams());
  const auto& poses = input.trajectory.poses;
  Recording recording;
  recording.observed.sensor = input.sensor;
  recording.observed.frames.resize(poses.size());
  Truth& truth = recording.truth.emplace();
  truth.walls = input.world.walls;
  truth.ranges.resize(poses.size() * n);
  truth.wall_ids.resize(poses.size() * n);
  for (const TimedPose& pose : poses) truth.world_from_sensor.push_back(pose.world_from_sensor);
  const std::vector<Pose2> odometry = odometry_poses(truth.world_from_sensor, input.odometry, input.seed);
  std::vector<double> cosines(n);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Frame& frame = recording.observed.frames[k];
    frame.stamp_s = poses[k].stamp_s;
    frame.odom_from_sensor = odometry[k];
    frame.ranges.resize(n);
    const std::span<double> ranges = std::span(truth.ranges).subspan(k * n, n);
    caster.cast_scans({&poses[k].world_from_sensor, 1}, {&poses[k].stamp_s, 1}, input.sensor.geometry,
                      input.sensor.range_max_m, {ranges, std::span(truth.wall_ids).subspan(k * n, n), cosines});
    for (std::size_t i = 0; i < n; ++i)
      frame.ranges[i] = observed_range(input.sensor, ranges[i], cosines[i],
                                       {input.seed, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(i)});
  }
  return truth.ranges.size();
}

void measure_simulation(int rounds) {
  SimulationInput input;
  input.world = fifteen_walls();
  input.sensor = make_sensor("ladar_2d30", {});
  input.trajectory = drive();
  measure("recording of 15 walls, 5 cm noise, a beam",
          {{"one ray at a time, Box2D's tree", [&] { return simulate_one_by_one(input); }},
           {"simulate", [&] { return simulate(input).truth->ranges.size(); }, 15}},
          rounds);
}

struct Subject {
  std::string name;
  std::function<void(int rounds)> measure;
};

std::vector<Subject> subjects() {
  const auto office = [](int side, double limit) {
    return [=](int rounds) {
      measure_casting(rooms(side), random_poses({1, 1}, {6.0 * side - 1, 5.0 * side - 1}), 1, limit, rounds);
    };
  };
  const auto cave = [](int corners, std::size_t every, double limit) {
    return [=](int rounds) { measure_casting(outline(corners), random_poses({-4, -4}, {4, 4}), every, limit, rounds); };
  };
  return {{"walls", [](int rounds) { measure_casting(fifteen_walls(), driven_poses(), 1, 50, rounds); }},
          {"rooms125", office(5, 0)},
          {"rooms1k", office(14, 17)},
          {"rooms10k", office(45, 30)},
          {"rooms100k", office(141, 35)},
          {"outline1k", cave(1000, 2, 0)},
          {"outline100k", cave(100000, 20, 20)},
          {"recording", measure_simulation}};
}

}  // namespace
}  // namespace scanbench::sim

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
  const std::string wanted = argc > 2 ? argv[2] : "";
  for (const auto& subject : scanbench::sim::subjects())
    if (subject.name.starts_with(wanted)) subject.measure(rounds);
}
