// Worlds for the tests of the simulator, and an independent ray caster.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/rng.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace scanbench::sim::test {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline void add_wall(World& world, const Vec2& a, const Vec2& b) {
  world.walls.push_back({"w" + std::to_string(world.walls.size() + 1), {a, b}});
}

inline void add_ring(World& world, const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) add_wall(world, corners[i], corners[(i + 1) % corners.size()]);
}

/// A rectangle from (0, 0) to (width, height); walls in the order bottom, right, top, left.
inline World box_world(double width, double height) {
  World world;
  world.name = "box";
  add_ring(world, {{0, 0}, {width, 0}, {width, height}, {0, height}});
  return world;
}

/// Fifteen walls in free air, some of them on one line and overlapping.
inline World borges_world() {
  World world;
  world.name = "fifteen lines";
  const double rows[15][4] = {{1.55, 0.75, 1.55, 1.65},     {1.95, 2.20, 2.45, 3.25},  {1.25, 11.25, 1.80, 11.25},
                              {1.55, 0.75, 1.55, 3.90},     {2.75, 0.00, 2.75, 0.45},  {9.75, 7.45, 9.75, 11.40},
                              {2.70, 10.00, 3.35, 10.00},   {0.00, 2.35, 0.00, 5.90},  {2.85, 5.15, 1.55, 3.75},
                              {11.15, 13.35, 13.50, 13.35}, {9.70, 7.40, 10.35, 7.40}, {1.90, 10.90, 2.50, 10.90},
                              {1.55, 10.90, 5.90, 10.90},   {3.20, 0.95, 3.20, 2.05},  {3.30, 9.90, 4.05, 9.70}};
  for (const auto& r : rows) add_wall(world, {r[0], r[1]}, {r[2], r[3]});
  return world;
}

/// Rooms of 6 m x 5 m with doors and a round pillar each, `columns` x `rows` of them from `corner` on.
inline World rooms_world(int columns, int rows, const Vec2& corner) {
  World world;
  world.name = "rooms";
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const Vec2 o = corner + Vec2(6.0 * i, 5.0 * j);
      add_wall(world, o, o + Vec2(2.5, 0));
      add_wall(world, o + Vec2(3.5, 0), o + Vec2(6, 0));
      add_wall(world, o, o + Vec2(0, 1.7));
      add_wall(world, o + Vec2(0, 2.6), o + Vec2(0, 5));
      add_wall(world, o + Vec2(1.1, 3.3), o + Vec2(2.3, 3.9));
      world.circles.push_back({"pillar", o + Vec2(4.5, 3.5), 0.21});
    }
  const Vec2 far = corner + Vec2(6.0 * columns, 5.0 * rows);
  add_wall(world, {far.x(), corner.y()}, far);
  add_wall(world, far, {corner.x(), far.y()});
  return world;
}

/// A closed outline of many short walls, a few decimetres large.
inline World small_ring_world(int corners) {
  World world;
  world.name = "small ring";
  std::vector<Vec2> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = kTwoPi * i / corners;
    const double radius = 0.3 + 0.08 * std::sin(5.0 * angle) + (i % 2 == 0 ? 0.004 : 0.0);
    outline.emplace_back(0.7 + radius * std::cos(angle), -0.2 + radius * std::sin(angle));
  }
  add_ring(world, outline);
  return world;
}

/// First range over all walls and circles in long double, by the definition: a wall is the points between its ends,
/// a ray that passes an end within 1e-11 m touches it, and one that starts within 1e-11 m of a wall touches it at once.
/// If `surfaces` is given, it receives the surfaces within 1e-8 m of that range.
inline double brute_force(const World& world, const Ray& ray, std::vector<int>* surfaces = nullptr) {
  using Real = long double;
  const Real ox = ray.origin.x();
  const Real oy = ray.origin.y();
  const Real dx = ray.direction.x();
  const Real dy = ray.direction.y();
  const Real infinity = std::numeric_limits<Real>::infinity();
  Real best = infinity;
  std::vector<Real> all;
  for (const Wall& wall : world.walls) {
    const Real ax = Real(wall.segment.a.x()) - ox;
    const Real ay = Real(wall.segment.a.y()) - oy;
    const Real ex = Real(wall.segment.b.x()) - Real(wall.segment.a.x());
    const Real ey = Real(wall.segment.b.y()) - Real(wall.segment.a.y());
    Real range = infinity;
    const Real determinant = dx * ey - dy * ex;
    if (determinant != 0) {
      const Real t = (ax * ey - ay * ex) / determinant;  // Cramer's rule for o + t d = a + u e
      const Real u = (ax * dy - ay * dx) / determinant;
      if (t >= 0 && u >= 0 && u <= 1) range = t;
    }
    for (const Real end : {Real(0), Real(1)}) {
      const Real px = ax + end * ex;
      const Real py = ay + end * ey;
      const Real t = px * dx + py * dy;
      if (std::fabs(px * dy - py * dx) <= 1e-11L && t >= 0) range = std::min(range, t);
    }
    const Real length2 = ex * ex + ey * ey;
    const Real foot = -(ax * ex + ay * ey) / length2;
    const Real aside = std::fabs(ax * ey - ay * ex) / std::sqrt(length2);
    if (aside <= 1e-11L && foot >= 0 && foot <= 1) range = 0;
    all.push_back(range);
    best = std::min(best, range);
  }
  for (const Circle& circle : world.circles) {
    // |o + t d - c|^2 = r^2
    const Real cx = ox - circle.center.x();
    const Real cy = oy - circle.center.y();
    const Real a = dx * dx + dy * dy;
    const Real b = cx * dx + cy * dy;
    const Real c = cx * cx + cy * cy - Real(circle.radius_m) * circle.radius_m;
    const Real discriminant = b * b - a * c;
    Real range = infinity;
    if (c <= 0)
      range = 0;
    else if (discriminant >= 0 && b < 0)
      range = (-b - std::sqrt(discriminant)) / a;
    all.push_back(range);
    best = std::min(best, range);
  }
  if (surfaces != nullptr) {
    surfaces->clear();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (best < infinity && all[i] <= best + 1e-8L) surfaces->push_back(static_cast<int>(i));
  }
  return static_cast<double>(best);
}

/// A point uniform in a rectangle.
inline Vec2 uniform_point(CounterRng& rng, const Vec2& low, const Vec2& high) {
  const double x = low.x() + rng.uniform() * (high.x() - low.x());
  const double y = low.y() + rng.uniform() * (high.y() - low.y());
  return {x, y};
}

inline Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace scanbench::sim::test
