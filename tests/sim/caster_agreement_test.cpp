// The fast caster, on every processor's kernels, against the reference and an independent brute force: random worlds, a
// million rays, corners and grazing rays among them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"
#include "core/sensor_model.hpp"
#include "sim/ray_caster.hpp"
#include "sim/ray_math.hpp"
#include "tests/sim/random_worlds.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

std::vector<Isa> isas() {
  if (best_isa() == Isa::baseline) return {Isa::baseline};
  return {Isa::baseline, best_isa()};
}

/// Results of some beams.
struct Answers {
  std::vector<double> ranges, cosines;
  std::vector<std::int32_t> walls, surfaces;

  explicit Answers(std::size_t n) : ranges(n), cosines(n), walls(n), surfaces(n) {}
  HitBuffers buffers() { return {ranges, walls, cosines, surfaces}; }
};

// Equal to the last bit, or two surfaces within 1e-9 m of each other.
void expect_same(const Answers& fast, const Answers& reference, const std::string& what) {
  int differences = 0;
  for (std::size_t i = 0; i < fast.ranges.size() && differences < 3; ++i) {
    const bool same = fast.surfaces[i] == reference.surfaces[i] && fast.ranges[i] == reference.ranges[i] &&
                      fast.walls[i] == reference.walls[i] && fast.cosines[i] == reference.cosines[i];
    const bool tie =
        fast.surfaces[i] >= 0 && reference.surfaces[i] >= 0 && std::fabs(fast.ranges[i] - reference.ranges[i]) <= 1e-9;
    EXPECT_TRUE(same || tie) << what << ", beam " << i << ": " << fast.ranges[i] << " on " << fast.surfaces[i]
                             << ", reference " << reference.ranges[i] << " on " << reference.surfaces[i];
    if (!same && !tie) ++differences;
  }
}

// About 10^6 rays over all worlds, geometries and poses.
TEST(CasterAgreement, ScansAreThoseOfTheReference) {
  CounterRng rng(1, RngStream::resampling);
  std::size_t rays = 0;
  for (int round = 0; round < 36; ++round) {
    const double size = std::pow(10.0, -1.0 + 4.0 * rng.uniform());
    const int walls = static_cast<int>(std::pow(10.0, 3.3 * rng.uniform())) + 1;
    const World world = test::tangle(walls, size, rng);
    const RayCaster reference(world, CasterKind::box2d);
    const double range_max = round % 3 == 0 ? 0.5 * size : 100.0 * size;
    const std::vector<Pose2> poses = test::poses_in(world, size, 10, rng);
    std::vector<double> stamps(poses.size());
    for (double& t : stamps) t = 20.0 * rng.uniform();
    for (const ScanGeometry& beams : test::geometries()) {
      const std::size_t n = poses.size() * static_cast<std::size_t>(beams.beams());
      Answers expected(n);
      reference.cast_scans(poses, stamps, beams, range_max, expected.buffers());
      for (const Isa isa : isas()) {
        Answers answers(n);
        RayCaster(world, CasterKind::exact, isa).cast_scans(poses, stamps, beams, range_max, answers.buffers());
        expect_same(answers, expected, "round " + std::to_string(round));
        rays += n;
      }
    }
  }
  EXPECT_GT(rays, 1000000U);
}

TEST(CasterAgreement, SingleRaysAndBentScansAreThoseOfTheReference) {
  CounterRng rng(2, RngStream::resampling);
  const ScanGeometry beams(-kPi, kTwoPi / 720.0, 720);
  for (int round = 0; round < 30; ++round) {
    const double size = std::pow(10.0, 3.0 * rng.uniform());
    const World world = test::tangle(static_cast<int>(std::pow(10.0, 3.3 * rng.uniform())) + 1, size, rng);
    const RayCaster reference(world, CasterKind::box2d);
    const double bend = std::pow(10.0, -4.0 + 4.5 * rng.uniform());
    for (const Pose2& pose : test::poses_in(world, size, 5, rng)) {
      std::vector<Vec2> directions;
      std::vector<Ray> rays;
      for (int i = 0; i < beams.beams(); ++i) {
        directions.push_back(
            Pose2(0.0, 0.0, bend * (2.0 * rng.uniform() - 1.0)).rotate(pose.rotate(beams.direction(i))));
        rays.push_back({pose.translation(), directions.back(), 3.0});
      }
      Answers expected(720);
      reference.cast_rays(rays, 10.0 * size, expected.buffers());
      for (const Isa isa : isas()) {
        const RayCaster caster(world, CasterKind::exact, isa);
        Answers bent(720);
        caster.cast_bent_scan({pose, 3.0, directions}, beams, 10.0 * size, bent.buffers());
        expect_same(bent, expected, "bent scan, round " + std::to_string(round));
        Answers single(720);
        caster.cast_rays(rays, 10.0 * size, single.buffers());
        expect_same(single, expected, "rays, round " + std::to_string(round));
      }
    }
  }
}

TEST(CasterAgreement, AllKernelsGiveTheSameBytes) {
  if (best_isa() == Isa::baseline) GTEST_SKIP() << "this processor has one set of kernels";
  CounterRng rng(3, RngStream::resampling);
  const ScanGeometry beams(radians(-120.0), radians(0.25), 961);
  for (int round = 0; round < 20; ++round) {
    const World world = test::tangle(round < 10 ? 30 : 1500, 10.0, rng);
    const std::vector<Pose2> poses = test::poses_in(world, 10.0, 10, rng);
    Answers one(poses.size() * 961);
    RayCaster(world, CasterKind::exact, Isa::baseline).cast_scans(poses, {}, beams, 30.0, one.buffers());
    for (const Isa isa : isas()) {
      Answers other(poses.size() * 961);
      RayCaster(world, CasterKind::exact, isa).cast_scans(poses, {}, beams, 30.0, other.buffers());
      ASSERT_EQ(one.ranges, other.ranges);
      ASSERT_EQ(one.surfaces, other.surfaces);
      ASSERT_EQ(one.walls, other.walls);
      ASSERT_EQ(one.cosines, other.cosines);
    }
  }
}

// The definition of test_worlds.hpp in long double; it knows no moving bodies.
TEST(CasterAgreement, ScansAreThoseOfTheBruteForce) {
  CounterRng rng(4, RngStream::resampling);
  const ScanGeometry beams(-kPi, kTwoPi / 500.0, 500);
  std::vector<int> surfaces;
  for (int round = 0; round < 8; ++round) {
    World world = round < 6 ? test::tangle(20 + 60 * round, 10.0, rng) : test::rooms_world(6, 6, {-18.0, -15.0});
    world.moving.clear();
    const RayCaster caster(world);
    // Rays do not start on walls, where the two definitions differ in which touch counts.
    for (int k = 0; k < 6; ++k) {
      const Pose2 pose(test::uniform_point(rng, {-12, -12}, {12, 12}), kTwoPi * rng.uniform());
      Answers answers(500);
      caster.cast_scans({&pose, 1}, {}, beams, 1e4, answers.buffers());
      for (int i = 0; i < 500; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double expected =
            test::brute_force(world, {pose.translation(), pose.rotate(beams.direction(i)), 0.0}, &surfaces);
        if (expected == test::kInf) {
          ASSERT_EQ(answers.ranges[at], test::kInf);
          continue;
        }
        ASSERT_NEAR(answers.ranges[at], expected, 1e-9);
        ASSERT_NE(std::ranges::find(surfaces, answers.surfaces[at]), surfaces.end());
      }
    }
  }
}

}  // namespace
}  // namespace scanbench::sim
