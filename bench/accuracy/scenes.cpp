// Generates rooms and random poses in their free space.
#include "bench/accuracy/scenes.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "harness/study/scenario/world_file.hpp"
#include "sim/ray_caster.hpp"
#include "sim/sensors.hpp"
#include "sim/simulate.hpp"

namespace scanbench::accuracy {
namespace {

constexpr double kClearance = 0.3;
constexpr int kScansPerRoom = 25;

void add_polygon(sim::World& world, const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    world.walls.push_back({std::to_string(world.walls.size() + 1), {corners[i], corners[(i + 1) % corners.size()]}});
}

std::vector<Vec2> l_shape(double width, double height, double notch_x, double notch_y) {
  return {{0, 0}, {width, 0}, {width, notch_y}, {notch_x, notch_y}, {notch_x, height}, {0, height}};
}

sim::World l_shaped_room() {
  sim::World world;
  world.name = "L-shaped room";
  add_polygon(world, l_shape(12, 9, 7, 5));
  add_polygon(world, {{2.0, 2.0}, {3.2, 2.0}, {3.2, 2.8}, {2.0, 2.8}});
  add_polygon(world, {{8.6, 1.2}, {9.6, 1.8}, {9.1, 2.6}, {8.1, 2.0}});
  return world;
}

// An L-shaped room of 6 to 14 m with up to four rotated boxes.
sim::World random_room(CounterRng& rng) {
  const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  sim::World world;
  world.name = "random room";
  const double width = between(6, 14), height = between(6, 14);
  const double notch_x = between(0.35, 0.75) * width, notch_y = between(0.35, 0.75) * height;
  add_polygon(world, l_shape(width, height, notch_x, notch_y));
  const int boxes = static_cast<int>(5 * rng.uniform());
  for (int b = 0; b < boxes; ++b) {
    const double turn = between(0, kPi / 2), half_x = between(0.25, 0.8), half_y = between(0.25, 0.8);
    const Vec2 u(std::cos(turn), std::sin(turn)), v = perpendicular(u);
    const double margin = std::hypot(half_x, half_y) + 0.1;
    const Vec2 middle(between(margin, width - margin), between(margin, notch_y - margin));
    add_polygon(world, {middle - half_x * u - half_y * v, middle + half_x * u - half_y * v,
                        middle + half_x * u + half_y * v, middle - half_x * u + half_y * v});
  }
  return world;
}

// A pose near another, with no wall between them.
Pose2 next_pose(const Pose2& pose, const sim::World& world, CounterRng& rng) {
  for (;;) {
    const Vec2 shift(0.3 * (2.0 * rng.uniform() - 1.0), 0.3 * (2.0 * rng.uniform() - 1.0));
    const Pose2 next = pose * Pose2(shift, radians(10.0) * (2.0 * rng.uniform() - 1.0));
    const bool clear = std::ranges::all_of(world.walls, [&](const Wall& w) {
      return distance(next.translation(), w.segment) > shift.norm() / 2 &&
             distance(pose.translation(), w.segment) > shift.norm() / 2;
    });
    if (shift.norm() <= 0.3 && clear) return next;
  }
}

sim::Trajectory random_poses(const sim::World& world, int count, double least_returns, bool in_pairs, CounterRng& rng) {
  const sim::RayCaster caster(world);
  Vec2 low = world.walls.front().segment.a, high = low;
  for (const Wall& w : world.walls)
    for (const Vec2& p : {w.segment.a, w.segment.b}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  sim::Trajectory trajectory;
  trajectory.continuous = false;
  while (std::ssize(trajectory.poses) < count) {
    const double x = low.x() + (high.x() - low.x()) * rng.uniform();
    const double y = low.y() + (high.y() - low.y()) * rng.uniform();
    const double yaw = kTwoPi * rng.uniform();
    const bool clear = std::ranges::all_of(world.walls, [&](const Wall& w) {
      return distance({x, y}, w.segment) >= kClearance;
    });
    if (!clear) continue;
    constexpr int kDirections = 72;
    int returns = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double a = kTwoPi * (k + 0.5) / kDirections;
      returns += caster.cast({{x, y}, {std::cos(a), std::sin(a)}, 0.0}, 1e3).wall >= 0;
    }
    if (returns < least_returns * kDirections) continue;
    trajectory.poses.push_back({static_cast<double>(trajectory.poses.size()), Pose2(x, y, yaw)});
    if (in_pairs)
      trajectory.poses.push_back(
          {static_cast<double>(trajectory.poses.size()), next_pose(Pose2(x, y, yaw), world, rng)});
  }
  return trajectory;
}

}  // namespace

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = {
      {.name = "random rooms", .file = "", .random_rooms = true},
      {.name = "Bremen hallway", .file = "hallway.yaml"},
      {.name = "15 walls (borges)", .file = "borges15.yaml", .least_returns = 0.4},
      {.name = "arena of panels (nist)", .file = "disaster_arena.yaml"},
      {.name = "L-shaped room", .file = ""},
      {.name = "corridor (siadat structured)", .file = "structured_indoor.yaml"},
      {.name = "34 boxes (siadat complex)", .file = "complex_indoor.yaml"},
      {.name = "four rooms", .file = "four_rooms.yaml"},
      {.name = "ETH hallway", .file = "hallway_80m.yaml"},
  };
  return all;
}

std::vector<Recording> recordings(const Scene& scene, double sigma_m, std::uint64_t seed) {
  std::vector<Recording> result;
  CounterRng rng(seed, RngStream::pose);
  const int rooms = scene.random_rooms ? scene.scans / kScansPerRoom : 1;
  for (int room = 0; room < rooms; ++room) {
    sim::SimulationInput input;
    if (!scene.file.empty())
      input.world =
          study::load_world(std::filesystem::path(SCANBENCH_SOURCE_DIR) / "scenarios/worlds" / scene.file).world;
    else
      input.world = scene.random_rooms ? random_room(rng) : l_shaped_room();
    input.sensor = sim::make_sensor("ladar_2d30", {{"sigma_m", sigma_m}});
    input.trajectory = random_poses(input.world, scene.scans / rooms, scene.least_returns, scene.in_pairs, rng);
    input.seed = seed * 1000 + static_cast<std::uint64_t>(room);
    result.push_back(sim::simulate(input));
  }
  return result;
}

}  // namespace scanbench::accuracy
