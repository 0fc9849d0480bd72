// Exact ray casting against closed forms and an independent brute force in long double.
#include "sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

// The largest difference of ranges over 100 000 rays, a tenth of them aimed exactly at ends of walls, a tenth along
// walls; also counts rays whose surface is not among those of the brute force.
struct Comparison {
  double largest = 0.0;
  int hits = 0;
  int disagreements = 0;  ///< one reports a hit, the other none
  int wrong_surfaces = 0;
};

Comparison compare_with_brute_force(const World& world, std::uint64_t seed) {
  Vec2 low = Vec2::Constant(test::kInf);
  Vec2 high = -low;
  for (const Wall& wall : world.walls) {
    low = low.cwiseMin(wall.segment.a).cwiseMin(wall.segment.b);
    high = high.cwiseMax(wall.segment.a).cwiseMax(wall.segment.b);
  }
  const RayCaster caster(world);
  CounterRng rng(seed, RngStream::resampling);
  Comparison result;
  std::vector<int> surfaces;
  for (int i = 0; i < 100000; ++i) {
    const Wall& wall = world.walls[static_cast<std::size_t>(rng.uniform() * static_cast<double>(world.walls.size()))];
    Ray ray;
    ray.origin = test::uniform_point(rng, low, high);
    if (i % 10 == 0) {
      const Vec2 end = rng.uniform() < 0.5 ? wall.segment.a : wall.segment.b;
      ray.direction = (end - ray.origin).normalized();
    } else if (i % 10 == 1) {
      ray.origin = wall.segment.a - rng.uniform() * (wall.segment.b - wall.segment.a);
      ray.direction = (wall.segment.b - ray.origin).normalized();
    } else {
      ray.direction = test::unit(kTwoPi * rng.uniform());
    }
    const RayHit hit = caster.cast(ray, 1e6);
    const double expected = test::brute_force(world, ray, &surfaces);
    if ((hit.range_m == test::kInf) != (expected == test::kInf)) {
      ++result.disagreements;
    } else if (expected != test::kInf) {
      ++result.hits;
      result.largest = std::max(result.largest, std::fabs(hit.range_m - expected));
      if (std::ranges::find(surfaces, hit.surface) == surfaces.end()) ++result.wrong_surfaces;
    }
  }
  return result;
}

void expect_agreement(const World& world, std::uint64_t seed, int least_hits) {
  const Comparison c = compare_with_brute_force(world, seed);
  EXPECT_GT(c.hits, least_hits);
  EXPECT_EQ(c.disagreements, 0);
  EXPECT_EQ(c.wrong_surfaces, 0);
  EXPECT_LT(c.largest, 1e-9);
}

TEST(RayCaster, AgreesWithBruteForceInFifteenFreeWalls) {
  expect_agreement(test::borges_world(), 1, 30000);
}

TEST(RayCaster, AgreesWithBruteForceInRoomsFarFromTheOrigin) {
  expect_agreement(test::rooms_world(4, 3, {480.0, -510.0}), 2, 90000);
}

TEST(RayCaster, AgreesWithBruteForceInASmallDenseOutline) {
  expect_agreement(test::small_ring_world(80), 3, 60000);
}

TEST(RayCaster, RangesInABoxAreTheClosedForm) {
  const RayCaster caster(test::box_world(4.0, 3.0));
  const RayHit right = caster.cast({{1.0, 1.0}, {1.0, 0.0}, 0.0}, 30.0);
  EXPECT_EQ(right.range_m, 3.0);
  EXPECT_EQ(right.wall, 1);
  EXPECT_EQ(right.cos_incidence, 1.0);
  // 30 deg above the x axis from (1, 1): hits the right wall after 3 / cos 30.
  const RayHit slanted = caster.cast({{1.0, 1.0}, test::unit(radians(30.0)), 0.0}, 30.0);
  EXPECT_NEAR(slanted.range_m, 3.0 / std::cos(radians(30.0)), 1e-12);
  EXPECT_NEAR(slanted.cos_incidence, std::cos(radians(30.0)), 1e-12);
  EXPECT_EQ(slanted.wall, 1);
}

TEST(RayCaster, ACornerThatTwoWallsShareNeverLeaks) {
  for (const int corners : {3, 7, 64}) {
    World world;
    std::vector<Vec2> outline;
    for (int i = 0; i < corners; ++i) outline.push_back(Vec2(300.1, -77.7) + 5.3 * test::unit(kTwoPi * i / corners));
    test::add_ring(world, outline);
    const RayCaster caster(world);
    CounterRng rng(7, RngStream::resampling, static_cast<std::uint32_t>(corners));
    for (int i = 0; i < 20000; ++i) {
      const auto k = static_cast<std::size_t>(i) % outline.size();
      const Vec2 origin = Vec2(300.1, -77.7) + rng.uniform() * 2.0 * test::unit(kTwoPi * rng.uniform());
      Vec2 direction = (outline[k] - origin).normalized();
      // Also the neighbours of the direction in floating point.
      if (i % 3 == 1) direction.x() = std::nextafter(direction.x(), 2.0);
      if (i % 3 == 2) direction.y() = std::nextafter(direction.y(), -2.0);
      const RayHit hit = caster.cast({origin, direction, 0.0}, 100.0);
      ASSERT_NEAR(hit.range_m, (outline[k] - origin).norm(), 1e-9);
      const auto before = static_cast<int>((k + outline.size() - 1) % outline.size());
      ASSERT_TRUE(hit.wall == static_cast<int>(k) || hit.wall == before);
    }
  }
}

TEST(RayCaster, ARayBesideTheEndOfAWallMissesIt) {
  World world;
  test::add_wall(world, {2.0, -1.0}, {2.0, 1.0});
  const RayCaster caster(world);
  EXPECT_EQ(caster.cast({{0, 1.0}, {1, 0}, 0}, 30).range_m, 2.0);
  EXPECT_EQ(caster.cast({{0, 1.0 + 1e-8}, {1, 0}, 0}, 30).range_m, test::kInf);
  EXPECT_EQ(caster.cast({{0, 1.0 + 5e-5}, {1, 0}, 0}, 30).wall, -1);
  // Edge-on: the nearer end.
  EXPECT_EQ(caster.cast({{2.0, 4.0}, {0, -1}, 0}, 30).range_m, 3.0);
  EXPECT_EQ(caster.cast({{2.0, 4.0}, {0, 1}, 0}, 30).range_m, test::kInf);
  EXPECT_EQ(caster.cast({{2.0, 0.5}, {0, 1}, 0}, 30).range_m, 0.0);
}

TEST(RayCaster, TheNearerOfTwoWallsANanometreApartWinsAndOverlapsGoToTheLowerIndex) {
  World world;
  test::add_wall(world, {400.0 + 1e-7, -1.0}, {400.0 + 1e-7, 1.0});
  test::add_wall(world, {400.0, -1.0}, {400.0, 1.0});
  test::add_wall(world, {400.0, -2.0}, {400.0, 0.5});
  test::add_wall(world, {-100.0, -1.0}, {-100.0, 1.0});
  const RayCaster caster(world);
  const RayHit hit = caster.cast({{0.0, 0.1}, {1, 0}, 0}, 1000);
  EXPECT_EQ(hit.wall, 1);
  EXPECT_EQ(hit.range_m, 400.0);
}

TEST(RayCaster, TheLargestRangeIsInclusiveAndSensorsMayBeFarOutside) {
  const RayCaster caster(test::box_world(4.0, 3.0));
  EXPECT_EQ(caster.cast({{1, 1}, {1, 0}, 0}, 3.0).range_m, 3.0);
  EXPECT_EQ(caster.cast({{1, 1}, {1, 0}, 0}, 3.0 - 1e-9).range_m, test::kInf);
  EXPECT_EQ(caster.cast({{-1e6, 1}, {1, 0}, 0}, 1e9).range_m, 1e6);
  EXPECT_EQ(caster.cast({{-1e6, 1}, {-1, 0}, 0}, 1e9).range_m, test::kInf);
}

TEST(RayCaster, CirclesReturnTheirEntryPointAndTheAngleThere) {
  World world = test::box_world(10.0, 10.0);
  world.circles.push_back({"pillar", {5.0, 5.0}, 1.0});
  const RayCaster caster(world);
  const RayHit centre = caster.cast({{1, 5}, {1, 0}, 0}, 30);
  EXPECT_EQ(centre.range_m, 3.0);
  EXPECT_EQ(centre.wall, -1);
  EXPECT_EQ(centre.surface, 4);
  EXPECT_EQ(centre.cos_incidence, 1.0);
  const RayHit side = caster.cast({{1, 5.6}, {1, 0}, 0}, 30);  // 0.6, 0.8, 1 triangle
  EXPECT_NEAR(side.range_m, 4.0 - 0.8, 1e-12);
  EXPECT_NEAR(side.cos_incidence, 0.8, 1e-12);
  EXPECT_EQ(caster.cast({{1, 6.001}, {1, 0}, 0}, 30).wall, 1);
}

TEST(RayCaster, MovingBodiesAreWhereTheyAreAtTheRaysTime) {
  World world = test::box_world(10.0, 10.0);
  world.moving.push_back({"person", 0.5, {{5.0, 0.5}, {5.0, 9.5}}, 1.0, false});
  const RayCaster caster(world);
  EXPECT_EQ(caster.cast({{1, 5}, {1, 0}, 0.0}, 30).range_m, 9.0);
  EXPECT_NEAR(caster.cast({{1, 5}, {1, 0}, 4.5}, 30).range_m, 3.5, 1e-12);
  EXPECT_EQ(caster.cast({{1, 5}, {1, 0}, 4.5}, 30).wall, -1);
  std::vector<double> ranges(2);
  const Ray rays[2] = {{{1, 5}, {1, 0}, 4.5}, {{1, 5}, {1, 0}, 9.0}};
  caster.cast_rays(rays, 30, {ranges, {}, {}});
  EXPECT_NEAR(ranges[0], 3.5, 1e-12);
  EXPECT_EQ(ranges[1], 9.0);
}

TEST(RayCaster, ABatchOfScansGivesTheSameAsItsRays) {
  const World world = test::rooms_world(3, 3, {0, 0});
  const RayCaster caster(world);
  const ScanGeometry beams(-kPi, radians(1.0), 360);
  const std::vector<Pose2> poses{{3.0, 2.0, 0.3}, {8.9, 7.1, -2.0}};
  std::vector<double> ranges(720);
  std::vector<double> cosines(720);
  std::vector<std::int32_t> ids(720);
  caster.cast_scans(poses, {}, beams, 12.0, {ranges, ids, cosines});
  for (std::size_t k = 0; k < 2; ++k)
    for (int i = 0; i < 360; ++i) {
      const RayHit hit = caster.cast({poses[k].translation(), poses[k].rotate(beams.direction(i)), 0}, 12.0);
      const std::size_t at = k * 360 + static_cast<std::size_t>(i);
      ASSERT_EQ(ranges[at], hit.range_m);
      ASSERT_EQ(ids[at], hit.wall);
      ASSERT_EQ(cosines[at], hit.cos_incidence);
    }
  EXPECT_THROW(caster.cast_scans(poses, {}, beams, 12.0, {std::span(ranges).first(719), {}, {}}), InternalError);
}

}  // namespace
}  // namespace scanbench::sim
