// The grid of walls against going through all of them.
#include "sim/wall_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "core/geometry.hpp"
#include "core/rng.hpp"

namespace scanbench::sim {
namespace {

/// Walls of all lengths and directions, axis-parallel ones among them, in a region of this size.
std::vector<Wall> random_walls(std::uint32_t seed, int n, const Vec2& size) {
  CounterRng rng(seed, RngStream::range);
  std::vector<Wall> walls;
  for (int i = 0; i < n; ++i) {
    const Vec2 a(size.x() * rng.uniform(), size.y() * rng.uniform());
    Vec2 b = a + size.maxCoeff() * rng.uniform() * rng.uniform() * Vec2(rng.normal(), rng.normal());
    if (i % 5 == 0) b.x() = a.x();
    if (i % 5 == 1) b.y() = a.y();
    walls.push_back({"w" + std::to_string(i), {a, b}});
  }
  return walls;
}

/// Smallest distance between two segments: an end of one is nearest, unless they cross.
double gap(const Segment& s, const Segment& t) {
  const auto side = [](const Segment& l, const Vec2& p) { return cross(Vec2(l.b - l.a), Vec2(p - l.a)); };
  if (side(s, t.a) * side(s, t.b) < 0 && side(t, s.a) * side(t, s.b) < 0) return 0.0;
  return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

const std::vector<Vec2> kSizes{{10, 10}, {1000, 3}, {0.5, 200}, {1e4, 0}};

TEST(WallGrid, LeavesOutNoWallThatIsNearAWay) {
  CounterRng rng(7, RngStream::range);
  for (const Vec2& size : kSizes)
    for (const int n : {1, 2, 17, 300}) {
      const std::vector<Wall> walls = random_walls(static_cast<std::uint32_t>(n), n, size);
      const WallGrid grid(walls);
      std::size_t near = 0;
      for (int k = 0; k < 200; ++k) {
        const auto place = [&] {
          return Vec2((1.4 * rng.uniform() - 0.2) * size.x(), (1.4 * rng.uniform() - 0.2) * size.y());
        };
        Segment way{place(), place()};
        if (k % 4 == 0) way.b = way.a;  // a pose
        if (k % 4 == 1) way.a = walls[static_cast<std::size_t>(k) % walls.size()].segment.a;
        if (k % 4 == 2) way.b = way.a + 0.01 * (way.b - way.a);
        std::set<std::size_t> visited;
        grid.for_each_near(way, [&](std::size_t i) { visited.insert(i); });
        for (std::size_t i = 0; i < walls.size(); ++i) {
          if (gap(way, walls[i].segment) > 0.99 * WallGrid::kMarginM) continue;
          ++near;
          EXPECT_TRUE(visited.contains(i)) << "size " << size.transpose() << ", wall " << i << ", way " << k;
        }
      }
      EXPECT_GT(near, 0U);
    }
}

TEST(WallGrid, KnowsWhetherAWallIsWithinADistance) {
  CounterRng rng(8, RngStream::range);
  for (const Vec2& size : kSizes)
    for (const int n : {1, 17, 300}) {
      std::vector<Wall> walls = random_walls(static_cast<std::uint32_t>(n) + 1, n, size);
      for (Wall& wall : walls) wall.segment.b = wall.segment.a + 0.02 * (wall.segment.b - wall.segment.a);
      const WallGrid grid(walls);
      for (int k = 0; k < 200; ++k) {
        const Vec2 p((3 * rng.uniform() - 1) * size.x(), (3 * rng.uniform() - 1) * size.y());
        double nearest = std::numeric_limits<double>::infinity();
        for (const Wall& wall : walls) nearest = std::min(nearest, distance(p, wall.segment));
        EXPECT_TRUE(grid.any_within(p, nearest));
        EXPECT_TRUE(grid.any_within(p, 1.5 * nearest));
        if (nearest > 0) {
          EXPECT_FALSE(grid.any_within(p, 0.999 * nearest));
        }
      }
    }
}

TEST(WallGrid, OfNoWallsHasNoneNearAnything) {
  const WallGrid grid({});
  grid.for_each_near({{-5, 3}, {1e4, 7}}, [](std::size_t) { ADD_FAILURE(); });
  EXPECT_FALSE(grid.any_within({1, 2}, 1e9));
}

}  // namespace
}  // namespace scanbench::sim
