// Spacing, headings and times of every kind of trajectory, motion within a scan, and paths that are not clear.
#include "sim/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/params.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

constexpr double kFarSight = std::numeric_limits<double>::infinity();  // a range that reaches every wall

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Trajectory make(std::string_view kind, const ParamSet& params, double period_s = 0.5) {
  return Registry<TrajectoryKind>::make(kind, params)->generate(period_s);
}

const Pose2& pose(const Trajectory& trajectory, std::size_t k) {
  return trajectory.poses[k].world_from_sensor;
}

void expect_pose(const Pose2& p, double x, double y, double heading_deg) {
  EXPECT_NEAR(p.x(), x, 1e-12);
  EXPECT_NEAR(p.y(), y, 1e-12);
  EXPECT_NEAR(wrap_angle(p.yaw() - radians(heading_deg)), 0.0, 1e-12);
}

std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

const NamedPoints kCorner{{"A", {0, 0}}, {"B", {3, 0}}, {"C", {3, 5}}};

TEST(Trajectories, AllKindsAreRegistered) {
  EXPECT_THAT(Registry<TrajectoryKind>::names(),
              ElementsAre("poses", "robots", "spiral", "step_and_shoot", "waypoints"));
}

TEST(Waypoints, ScansAreAtTheMiddleOfEqualIntervalsAndLookAhead) {
  // 8 m in four intervals: 1, 3, 5, 7 m from A; 3 m is B itself, which ends the first piece.
  const Trajectory t = make("waypoints", {{"points_m", kCorner}, {"scans", std::int64_t{4}}});
  ASSERT_EQ(t.poses.size(), 4U);
  expect_pose(pose(t, 0), 1, 0, 0);
  expect_pose(pose(t, 1), 3, 0, 0);
  expect_pose(pose(t, 2), 3, 2, 90);
  expect_pose(pose(t, 3), 3, 4, 90);
  EXPECT_EQ(pose(t, 0).cos(), 1.0);  // exact
  EXPECT_EQ(pose(t, 2).cos(), 0.0);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(t.poses[k].stamp_s, 0.5 * static_cast<double>(k));
  EXPECT_EQ(t.waypoints, kCorner);
  EXPECT_TRUE(t.continuous);
}

TEST(Waypoints, TheHeadingOffsetRotatesTheSensor) {
  const Trajectory t =
      make("waypoints", {{"points_m", kCorner}, {"scans", std::int64_t{4}}, {"heading_offset_deg", std::int64_t{180}}});
  expect_pose(pose(t, 0), 1, 0, 180);
  expect_pose(pose(t, 3), 3, 4, -90);
}

TEST(Waypoints, BySpeedAScanIsTakenEveryPeriodFromTheStart) {
  const Trajectory t = make("waypoints", {{"points_m", kCorner}, {"speed_mps", 4.0}}, 0.5);  // 2 m apart
  ASSERT_EQ(t.poses.size(), 5U);
  expect_pose(pose(t, 0), 0, 0, 0);
  expect_pose(pose(t, 1), 2, 0, 0);
  expect_pose(pose(t, 2), 3, 1, 90);
  expect_pose(pose(t, 4), 3, 5, 90);
}

TEST(Waypoints, FaultsAreNamed) {
  const ParamValue four = std::int64_t{4};
  EXPECT_THAT(complaint([&] { make("waypoints", {{"scans", four}}); }), HasSubstr("points_m has 0 points"));
  EXPECT_THAT(complaint([&] { make("waypoints", {{"points_m", kCorner}}); }), HasSubstr("neither scans nor speed_mps"));
  EXPECT_THAT(complaint([&] {
                make("waypoints", {{"points_m", kCorner}, {"scans", four}, {"speed_mps", 1.0}});
              }),
              HasSubstr("both given"));
  EXPECT_THAT(complaint([&] {
                make("waypoints", {{"points_m", kCorner}, {"speed_mps", 1e-9}});
              }),
              HasSubstr("speed_mps makes"));
  const NamedPoints twice{{"A", {0, 1}}, {"B", {0, 1}}};
  EXPECT_THAT(complaint([&] {
                make("waypoints", {{"points_m", twice}, {"scans", four}});
              }),
              HasSubstr("A and B are both at (0, 1) m"));
}

TEST(Spiral, ScansAreEquallySpacedOnTheSpiralAndLookAlongIt) {
  const Trajectory t = make("spiral", {{"center_m", std::vector<double>{2, -1}},
                                       {"inner_radius_m", 0.4},
                                       {"outer_radius_m", 3.0},
                                       {"turns", std::int64_t{3}},
                                       {"scans", std::int64_t{50}}});
  ASSERT_EQ(t.poses.size(), 50U);
  // The same by brute force: a polyline of a million pieces.
  const int pieces = 1000000;
  const auto at = [&](int i) {
    const double u = static_cast<double>(i) / pieces;
    return Vec2(Vec2(2, -1) + (0.4 + 2.6 * u) * test::unit(3.0 * kTwoPi * u));
  };
  double length = 0.0;
  for (int i = 0; i < pieces; ++i) length += (at(i + 1) - at(i)).norm();
  double way = 0.0;
  std::size_t k = 0;
  for (int i = 0; i < pieces && k < 50; ++i) {
    const Vec2 step = at(i + 1) - at(i);
    way += step.norm();
    if (way < length * (static_cast<double>(k) + 0.5) / 50.0) continue;
    EXPECT_LT((pose(t, k).translation() - at(i + 1)).norm(), 1e-4);
    EXPECT_LT((Vec2(pose(t, k).cos(), pose(t, k).sin()) - step.normalized()).norm(), 1e-4);
    ++k;
  }
  EXPECT_EQ(k, 50U);
}

TEST(Spiral, ACircleIsTheSpecialCase) {
  const Trajectory t = make("spiral", {{"inner_radius_m", 2.0},
                                       {"outer_radius_m", 2.0},
                                       {"turns", std::int64_t{-1}},
                                       {"start_deg", std::int64_t{90}},
                                       {"scans", std::int64_t{4}}});
  expect_pose(pose(t, 0), std::sqrt(2.0), std::sqrt(2.0), -45);  // clockwise from the top
  expect_pose(pose(t, 1), std::sqrt(2.0), -std::sqrt(2.0), -135);
}

TEST(Spiral, FaultsAreNamed) {
  EXPECT_THAT(complaint([] { make("spiral", {{"turns", 0.0}}); }), HasSubstr("turns is 0"));
  EXPECT_THAT(complaint([] {
                make("spiral", {{"center_m", std::vector<double>{1}}});
              }),
              HasSubstr("center_m has 1 numbers"));
  EXPECT_THAT(complaint([] {
                make("spiral", {{"inner_radius_m", 0.0}, {"outer_radius_m", 0.0}});
              }),
              HasSubstr("both 0"));
}

TEST(StepAndShoot, StopsAreOneStepApartAndEachHasAllHeadings) {
  const Trajectory t = make("step_and_shoot", {{"start_m", std::vector<double>{1, 2}},
                                               {"direction_deg", std::int64_t{90}},
                                               {"step_m", 0.93},
                                               {"stops", std::int64_t{9}},
                                               {"headings_deg", std::vector<double>{90, 0, -90}}});
  ASSERT_EQ(t.poses.size(), 27U);
  for (std::size_t k = 0; k < 27; ++k) {
    const double heading = k % 3 == 0 ? 180.0 : (k % 3 == 1 ? 90.0 : 0.0);
    expect_pose(pose(t, k), 1, 2 + 0.93 * static_cast<double>(k / 3), heading);
  }
  EXPECT_TRUE(t.stops);
  EXPECT_THAT(complaint([] {
                make("step_and_shoot", {{"headings_deg", std::vector<double>{}}});
              }),
              HasSubstr("headings_deg is empty"));
}

TEST(Poses, RowsAreTakenUnchanged) {
  const NumberRows rows{{1, 2, 30}, {3, 4, -90}};
  const Trajectory t = make("poses", {{"poses", rows}});
  ASSERT_EQ(t.poses.size(), 2U);
  expect_pose(pose(t, 0), 1, 2, 30);
  expect_pose(pose(t, 1), 3, 4, -90);
  EXPECT_TRUE(t.continuous);
  EXPECT_FALSE(make("poses", {{"poses", rows}, {"continuous", false}}).continuous);
  EXPECT_FALSE(make("robots", {{"robots", rows}}).continuous);
  EXPECT_THAT(complaint([] { make("poses", {}); }), HasSubstr("poses is empty"));
  EXPECT_THAT(complaint([] {
                make("robots", {{"robots", NumberRows{{1, 2, 3}, {1, 2}}}});
              }),
              HasSubstr("robots row 2 has 2 numbers"));
}

TEST(PoseDuringScan, FollowsTheArcOfConstantTwistAndGoesOnBeyondTheLastPose) {
  // A quarter of a circle of radius 2 about the origin per second.
  Trajectory t;
  t.poses = {{0.0, {2, 0, radians(90)}}, {1.0, {0, 2, radians(180)}}};
  const double h = std::sqrt(2.0);
  expect_pose(pose_during_scan(t, 0, 0.0), 2, 0, 90);
  expect_pose(pose_during_scan(t, 0, 0.5), h, h, 135);
  expect_pose(pose_during_scan(t, 0, 1.0), 0, 2, 180);
  expect_pose(pose_during_scan(t, 1, 0.5), -h, h, 225);
  t.stops = true;
  expect_pose(pose_during_scan(t, 0, 0.5), 2, 0, 90);
  t.stops = false;
  t.continuous = false;
  expect_pose(pose_during_scan(t, 0, 0.5), 2, 0, 90);
}

Trajectory driven(std::vector<Pose2> poses) {
  Trajectory t;
  for (const Pose2& p : poses) t.poses.push_back({static_cast<double>(t.poses.size()), p});
  return t;
}

TEST(CheckClear, NamesTheWallAndThePlaceThatAPathCrosses) {
  World world = test::box_world(10, 10);
  world.walls.push_back({"door", {{5, 4}, {5, 6}}});
  EXPECT_EQ(complaint([&] {
              check_clear(world, driven({{1, 5, 0}, {9, 5.5, 0}}), kFarSight);
            }),
            "the path from (1, 5) m to (9, 5.5) m crosses wall 'door' at (5, 5.25) m; paths must keep clear of walls");
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{5, 1, 0}, {5, 9, 0}}), kFarSight);
              }),
              HasSubstr("'door' at (5, 4) m"));
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{1, 4, 0}, {9, 4, 0}}), kFarSight);
              }),
              HasSubstr("'door' at (5, 4) m"));
  EXPECT_NO_THROW(check_clear(world, driven({{1, 3.9, 0}, {9, 3.9, 0}}), kFarSight));
  // Placed sensors have no path; a known path takes precedence over the chords between the poses.
  Trajectory placed = driven({{1, 5, 0}, {9, 5.5, 0}});
  placed.continuous = false;
  EXPECT_NO_THROW(check_clear(world, placed, kFarSight));
  Trajectory around = driven({{4, 5, 0}, {6, 5, 0}});
  around.path = {{4, 5}, {4, 3}, {6, 3}, {6, 5}};
  EXPECT_NO_THROW(check_clear(world, around, kFarSight));
  around.path = {{4, 5}, {-1, 5}};
  EXPECT_THAT(complaint([&] { check_clear(world, around, kFarSight); }), HasSubstr("'w4' at (0, 5) m"));
}

// Short walls in a large world, so that most paths are clear; the error names the first wall in the world's order.
TEST(CheckClear, FindsTheSameWallAsABruteForceSearch) {
  CounterRng rng(3, RngStream::range);
  const auto place = [&](double size) { return Vec2(size * (rng.uniform() - 0.5), size * (rng.uniform() - 0.5)); };
  World world;
  for (int i = 0; i < 400; ++i) {
    const Vec2 a = place(40.0);
    world.walls.push_back({"w" + std::to_string(i), {a, a + place(i % 40 == 0 ? 30.0 : 2.0)}});
  }
  const auto crosses = [](const Segment& s, const Segment& t) {
    const auto side = [](const Segment& l, const Vec2& p) { return cross(Vec2(l.b - l.a), Vec2(p - l.a)) > 0; };
    return side(s, t.a) != side(s, t.b) && side(t, s.a) != side(t, s.b);
  };
  int clear = 0, blocked = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec2 from = place(50.0);
    const Segment way{from, from + place(k % 10 == 0 ? 60.0 : 3.0)};
    Trajectory trajectory = driven({Pose2(100, 100, 0)});
    trajectory.path = {way.a, way.b};
    const auto first = std::ranges::find_if(world.walls, [&](const Wall& w) { return crosses(way, w.segment); });
    const std::string said = complaint([&] { check_clear(world, trajectory, kFarSight); });
    if (first == world.walls.end()) {
      ++clear;
      EXPECT_EQ(said, "no error");
    } else {
      ++blocked;
      EXPECT_THAT(said, HasSubstr("crosses wall '" + first->label + "' at"));
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(blocked, 50);
}

TEST(CheckClear, NamesTheNearestSurfaceAmongManyWalls) {
  CounterRng rng(4, RngStream::range);
  World world;
  for (int i = 0; i < 300; ++i) {
    const Vec2 a(30.0 * rng.uniform(), 30.0 * rng.uniform());
    world.walls.push_back({"w" + std::to_string(i), {a, a + Vec2(rng.normal(), rng.normal())}});
  }
  for (int k = 0; k < 300; ++k) {
    const Vec2 p(90.0 * rng.uniform() - 30.0, 90.0 * rng.uniform() - 30.0);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : world.walls) nearest = std::min(nearest, distance(p, wall.segment));
    ASSERT_GT(nearest, 1e-3);
    const Trajectory standing = driven({Pose2(p.x(), p.y(), 0)});
    EXPECT_EQ(complaint([&] { check_clear(world, standing, 1.001 * nearest); }), "no error");
    EXPECT_THAT(complaint([&] { check_clear(world, standing, 0.999 * nearest); }), HasSubstr("outside any free space"));
  }
}

TEST(CheckClear, NamesTheBodyThatAPathOrASensorIsIn) {
  World world = test::box_world(10, 10);
  world.circles.push_back({"pillar", {5, 5}, 0.5});
  world.moving.push_back({"person", 0.3, {{1, 8}, {9, 8}}, 1.0, false});
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{1, 5.4, 0}, {9, 5.4, 0}}), kFarSight);
              }),
              HasSubstr("runs through circle 'pillar', radius 0.5 m about (5, 5) m"));
  EXPECT_NO_THROW(check_clear(world, driven({{1, 5.6, 0}, {9, 5.6, 0}}), kFarSight));
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{5, 4.6, 0}}), kFarSight);
              }),
              HasSubstr("scan 0: the sensor at (5, 4.6) m is inside circle 'pillar'"));
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{2, 7.9, 0}, {2, 7.9, 1}}), kFarSight);
              }),
              HasSubstr("scan 1: the sensor at (2, 7.9) m is inside moving body 'person' at 1 s"));
}

TEST(CheckClear, RefusesSensorsOnWallsOrWhereNothingCanBeSeen) {
  const World world = test::borges_world();
  EXPECT_NO_THROW(check_clear(world, driven({{-3, -3, 0}}), 30.0));  // free air is fine
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{1.5505, 1, 0}}), kFarSight);
              }),
              HasSubstr("is on wall 'w1'"));
  EXPECT_NO_THROW(check_clear(world, driven({{1.552, 1, 0}}), kFarSight));
  EXPECT_THAT(
      complaint([&] {
        check_clear(world, driven({{-10, 4, 0}}), 9.5);
      }),
      HasSubstr(
          "outside any free space: the nearest surface, wall 'w8', is 10 m away, and the sensor's range is 9.5 m"));
  EXPECT_THAT(complaint([&] {
                check_clear(world, driven({{-10, 4, 0}}), 1e-6);
              }),
              HasSubstr("the sensor's range is 1e-06 m"));
  const double nan = std::nan("");
  Trajectory wild;
  wild.poses = {{0.0, Pose2(Vec2(nan, 0.0), 0.0)}};
  EXPECT_THAT(complaint([&] { check_clear(world, wild, kFarSight); }), HasSubstr("not a finite number"));
  Trajectory standing;
  standing.poses = {{1.0, {-3, -3, 0}}, {1.0, {-3, -3, 0}}};
  EXPECT_THAT(complaint([&] { check_clear(world, standing, kFarSight); }), HasSubstr("scan 1: its time is not after"));
}

}  // namespace
}  // namespace scanbench::sim
