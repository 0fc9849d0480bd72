// Random worlds, poses and sensors on which casters are compared: crossings, overlaps, corners and grazing rays.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "sim/world.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim::test {

/// Walls of all lengths that cross and overlap anywhere, some of them continued on their own line, some end to end.
inline World tangle(int walls, double size, CounterRng& rng) {
  World world;
  world.name = "tangle";
  const Vec2 low(-size, -size);
  const Vec2 high(size, size);
  while (static_cast<int>(world.walls.size()) < walls) {
    const Vec2 a = uniform_point(rng, low, high);
    const double length = size * std::pow(10.0, -3.0 * rng.uniform());
    const Vec2 b = a + length * unit(kTwoPi * rng.uniform());
    add_wall(world, a, b);
    if (rng.uniform() < 0.2) add_wall(world, b, b + length * unit(kTwoPi * rng.uniform()));
    if (rng.uniform() < 0.1) add_wall(world, a + 0.5 * (b - a), b + 0.25 * (b - a));
  }
  for (int i = 0; i < walls / 20; ++i)
    world.circles.push_back({"pillar", uniform_point(rng, low, high), 0.001 * size + 0.02 * size * rng.uniform()});
  if (rng.uniform() < 0.5) world.moving.push_back({"walker", 0.02 * size, {low, high}, 0.1 * size, true});
  return world;
}

/// Poses anywhere, some of them level with a wall, at a corner or on it.
inline std::vector<Pose2> poses_in(const World& world, double size, int count, CounterRng& rng) {
  std::vector<Pose2> poses;
  for (int k = 0; k < count; ++k) {
    Vec2 at = uniform_point(rng, {-1.3 * size, -1.3 * size}, {1.3 * size, 1.3 * size});
    double yaw = kTwoPi * rng.uniform();
    const Segment& wall =
        world.walls[static_cast<std::size_t>(rng.uniform() * static_cast<double>(world.walls.size()))].segment;
    if (k % 5 == 1) {  // looking along a wall
      at = wall.a - (0.1 + rng.uniform()) * (wall.b - wall.a);
      yaw = std::atan2(wall.b.y() - wall.a.y(), wall.b.x() - wall.a.x());
    } else if (k % 5 == 2) {  // looking at a corner
      yaw = std::atan2(wall.a.y() - at.y(), wall.a.x() - at.x());
    } else if (k % 50 == 3) {
      at = wall.a;
    } else if (k % 50 == 4) {
      at = wall.midpoint();
    } else if (k % 50 == 8) {
      at = wall.midpoint() + 1e-12 * perpendicular(wall.direction());
    }
    poses.emplace_back(at, yaw);
  }
  return poses;
}

/// Sensors that are difficult for tests of intervals: a full turn, nearly one, a part, clockwise, very few beams, very
/// many.
inline std::vector<ScanGeometry> geometries() {
  return {{-kPi, kTwoPi / 360.0, 360},
          {-kPi, kTwoPi / 361.0, 360},
          {radians(-135.0), radians(0.6), 451},
          {radians(135.0), radians(-0.6), 451},
          {0.0, 0.0, 1},
          {2.0, 1.7, 3},
          {0.0, kTwoPi / 8.0, 8},
          {0.1, radians(0.01), 777}};
}

}  // namespace scanbench::sim::test
