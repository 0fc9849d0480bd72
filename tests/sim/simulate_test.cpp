// Whole recordings: truth and observation, threads, invariances, sweeps.
#include "sim/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/recording.hpp"
#include "core/truth.hpp"
#include "sim/sensors.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

using ::testing::HasSubstr;

Trajectory drive(const std::vector<Pose2>& poses, double period_s = 0.1) {
  Trajectory t;
  for (const Pose2& p : poses) t.poses.push_back({static_cast<double>(t.poses.size()) * period_s, p});
  return t;
}

Trajectory drive_through_rooms(int scans) {
  std::vector<Pose2> poses;
  for (int i = 0; i < scans; ++i) poses.emplace_back(0.7 + 4.0 * i / scans, 0.5 + 1.9 * i / scans, 0.3 + 0.02 * i);
  return drive(poses);
}

TEST(Simulate, APaneReturnsNothingAndTheOtherWallsReadAsBefore) {
  SimulationInput input;
  input.world.walls = {{"wall", {{3, -4}, {3, 0}}}, {"pane", {{3, 0}, {3, 4}}}, {"behind", {{6, -9}, {6, 9}}}};
  input.sensor = make_sensor("ladar_2d30", {{"sigma_m", 0.02}});
  input.trajectory = drive({{0, 0, 0}, {0.2, 0.1, 0.1}});
  const Recording plain = simulate(input);
  input.world.losses = {0.0, 1.0, 0.0};
  const Recording glazed = simulate(input);
  EXPECT_EQ(plain.truth->ranges, glazed.truth->ranges);
  EXPECT_EQ(plain.truth->wall_ids, glazed.truth->wall_ids);
  const std::size_t n = plain.observed.frames[0].ranges.size();
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_EQ(glazed.observed.frames[k].ranges[i],
                glazed.truth->wall_ids[k * n + i] == 1 ? test::kInf : plain.observed.frames[k].ranges[i]);
}

SimulationInput noisy_rooms(int scans) {
  SimulationInput input;
  input.world = test::rooms_world(3, 3, {0, 0});
  input.world.moving.push_back({"person", 0.2, {{1.0, 3.5}, {3.0, 4.5}}, 1.0, true});
  input.sensor = make_sensor("urg_04lx", {{"bearing_sigma_deg", 0.1},
                                          {"dropout_probability", 0.05},
                                          {"dropout_grazing", 0.3},
                                          {"spurious_probability", 0.01},
                                          {"beam_divergence_deg", 0.2},
                                          {"beams", std::int64_t{100}},
                                          {"angle_step_deg", 2.4}});
  input.trajectory = drive_through_rooms(scans);
  input.odometry = {0.02, 0.01, 0.05, 0.01, 0.01};
  input.tilt = {0.05, 0.05, 0.5};
  input.sweep = true;
  input.seed = 99;
  return input;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expect_same(const Recording& a, const Recording& b) {
  ASSERT_EQ(a.observed.frames.size(), b.observed.frames.size());
  EXPECT_TRUE(same_bytes(a.truth->ranges, b.truth->ranges));
  EXPECT_EQ(a.truth->wall_ids, b.truth->wall_ids);
  for (std::size_t k = 0; k < a.observed.frames.size(); ++k) {
    EXPECT_TRUE(same_bytes(a.observed.frames[k].ranges, b.observed.frames[k].ranges)) << k;
    EXPECT_EQ(a.observed.frames[k].odom_from_sensor, b.observed.frames[k].odom_from_sensor);
  }
}

TEST(Simulate, TheSameBytesForAnyNumberOfThreads) {
  const SimulationInput input = noisy_rooms(61);
  const Recording one = simulate(input, 1);
  expect_same(one, simulate(input, 2));
  expect_same(one, simulate(input, 3));
  expect_same(one, simulate(input, 1));
}

TEST(Simulate, AnotherSeedGivesOtherNoiseAndTheSameTruth) {
  SimulationInput input = noisy_rooms(10);
  const Recording one = simulate(input);
  input.seed = 100;
  const Recording other = simulate(input);
  EXPECT_TRUE(same_bytes(one.truth->ranges, other.truth->ranges));
  EXPECT_FALSE(same_bytes(one.observed.frames[0].ranges, other.observed.frames[0].ranges));
}

TEST(Simulate, TruthIsTheBruteForceRangeOfTheNominalBeamsAndObservationWithoutNoiseIsTheTruth) {
  SimulationInput input;
  input.world = test::rooms_world(3, 3, {0, 0});
  input.sensor = make_sensor("custom", {{"range_max_m", 8.0}});
  input.trajectory = drive_through_rooms(5);
  const Recording recording = simulate(input);
  const Truth& truth = *recording.truth;
  ASSERT_EQ(truth.ranges.size(), 5U * 361U);
  int nothing = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const Pose2& pose = truth.world_from_sensor[k];
    EXPECT_EQ(pose, input.trajectory.poses[k].world_from_sensor);
    EXPECT_EQ(recording.observed.frames[k].odom_from_sensor, pose);
    for (std::size_t i = 0; i < 361; ++i) {
      const Vec2 direction = pose.rotate(input.sensor.geometry.direction(static_cast<int>(i)));
      std::vector<int> surfaces;
      const double expected = test::brute_force(input.world, {pose.translation(), direction, 0}, &surfaces);
      const std::size_t at = k * 361 + i;
      EXPECT_EQ(recording.observed.frames[k].ranges[i], truth.ranges[at]);
      if (expected > 8.0) {
        EXPECT_EQ(truth.ranges[at], test::kInf);
        EXPECT_EQ(truth.wall_ids[at], -1);
        ++nothing;
      } else {
        EXPECT_NEAR(truth.ranges[at], expected, 1e-9);
        const bool circle = surfaces.front() >= static_cast<int>(input.world.walls.size());
        EXPECT_EQ(truth.wall_ids[at], circle ? -1 : surfaces.front());
      }
    }
  }
  EXPECT_GT(nothing, 0);
}

TEST(Simulate, RotatingSensorAndWorldTogetherLeavesTheRangesUnchanged) {
  SimulationInput input;
  input.world = test::rooms_world(2, 2, {0, 0});
  input.sensor = make_sensor("custom", {});
  input.trajectory = drive_through_rooms(4);
  const Recording before = simulate(input);
  const Pose2 motion(300.0, -120.0, 0.7);
  for (Wall& wall : input.world.walls) wall.segment = motion * wall.segment;
  for (Circle& circle : input.world.circles) circle.center = motion * circle.center;
  for (TimedPose& pose : input.trajectory.poses) pose.world_from_sensor = motion * pose.world_from_sensor;
  const Recording after = simulate(input);
  int finite = 0;
  for (std::size_t i = 0; i < before.truth->ranges.size(); ++i) {
    if (before.truth->ranges[i] == test::kInf) {
      EXPECT_EQ(after.truth->ranges[i], test::kInf);
      continue;
    }
    ++finite;
    EXPECT_NEAR(after.truth->ranges[i], before.truth->ranges[i], 1e-9);
    EXPECT_EQ(after.truth->wall_ids[i], before.truth->wall_ids[i]);
  }
  EXPECT_GT(finite, 1000);
}

TEST(Simulate, EachBeamOfASweepIsFiredFromItsOwnPlace) {
  // Towards the wall x = 10 at 2 m/s from x = 1: the beam that looks ahead after t seconds reads 9 - 2 t.
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.sensor = make_sensor("custom", {{"angle_min_deg", std::int64_t{-1}},
                                        {"angle_step_deg", 0.01},
                                        {"beams", std::int64_t{201}},
                                        {"time_per_beam_s", 0.0005}});
  input.trajectory = drive({{1.0, 5, 0}, {1.2, 5, 0}});
  input.sweep = true;
  const Recording swept = simulate(input);
  for (const int i : {0, 37, 100, 200}) {
    const double x = 1.0 + 2.0 * 0.0005 * i;
    const double expected = (10.0 - x) / std::cos(input.sensor.geometry.angle(i));
    EXPECT_NEAR(swept.truth->ranges[static_cast<std::size_t>(i)], expected, 1e-10);
    EXPECT_NEAR(swept.truth->ranges[static_cast<std::size_t>(201 + i)],
                expected - 0.2 / std::cos(input.sensor.geometry.angle(i)), 1e-10);
  }
  input.sweep = false;
  EXPECT_NEAR(simulate(input).truth->ranges[200], 9.0 / std::cos(radians(1.0)), 1e-10);
}

TEST(Simulate, APersonWalksThroughTheScans) {
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.world.moving.push_back({"person", 0.25, {{5, 1}, {5, 9}}, 1.0, false});
  input.sensor = make_sensor("custom", {{"angle_min_deg", std::int64_t{0}}, {"beams", std::int64_t{1}}});
  input.trajectory = drive({{1, 5, 0}, {1, 5, 0}, {1, 5, 0}}, 4.0);  // the person is ahead at 4 s
  const Recording recording = simulate(input);
  EXPECT_EQ(recording.truth->ranges[0], 9.0);
  EXPECT_NEAR(recording.truth->ranges[1], 3.75, 1e-12);
  EXPECT_EQ(recording.truth->wall_ids[1], -1);
  EXPECT_EQ(recording.truth->ranges[2], 9.0);
}

TEST(Simulate, BearingNoiseMovesReadingsAlongTheWallAndNotTheTruth) {
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.sensor = make_sensor(
      "custom", {{"angle_min_deg", std::int64_t{45}}, {"beams", std::int64_t{1}}, {"bearing_sigma_deg", 0.1}});
  std::vector<Pose2> poses(3000, Pose2(2, 8, radians(-45)));  // the beam looks along x: reads 8 / cos(error)
  input.trajectory = drive(poses);
  const Recording recording = simulate(input);
  double squares = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_NEAR(recording.truth->ranges[k], 8.0, 1e-12);
    const double error = std::acos(std::min(1.0, 8.0 / recording.observed.frames[k].ranges[0]));
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / 3000.0), radians(0.1), 5.0 * radians(0.1) / std::sqrt(6000.0));
}

TEST(Simulate, MixedPixelsAppearOnlyAtDepthEdgesAndAreBetweenTheSurfaces) {
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.world.walls.push_back({"panel", {{4, 5}, {4, 8}}});  // seen from (1, 5): its end is straight ahead
  input.sensor = make_sensor("custom", {{"angle_min_deg", std::int64_t{-30}},
                                        {"angle_step_deg", std::int64_t{1}},
                                        {"beams", std::int64_t{61}},
                                        {"beam_divergence_deg", 0.5}});
  std::vector<Pose2> poses(500, Pose2(1, 5, 0));
  input.trajectory = drive(poses);
  const Recording recording = simulate(input);
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (std::size_t i = 0; i < 61; ++i) {
      const double reading = recording.observed.frames[k].ranges[i];
      if (i == 30) {
        EXPECT_GT(reading, 3.0 - 1e-3);
        EXPECT_LT(reading, 9.0 + 1e-3);
        EXPECT_NE(reading, recording.truth->ranges[k * 61 + i]);
      } else {
        EXPECT_NEAR(reading, recording.truth->ranges[k * 61 + i], 1e-12) << i;
      }
    }
}

TEST(Simulate, ProgressGrowsToOneAndAnExceptionInItEndsTheSimulation) {
  const SimulationInput input = noisy_rooms(40);
  double last = 0.0;
  simulate(input, 2, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(simulate(input, 2, [](double) { throw ConfigError("stop"); }), ConfigError);
}

TEST(Simulate, ChecksThePathTheWorldAndTheSweepFirst) {
  const auto complaint = [](const SimulationInput& input) -> std::string {
    try {
      simulate(input);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no error";
  };
  SimulationInput through = noisy_rooms(3);
  through.trajectory = drive({{1, 0.5, 0}, {1, -0.5, 0}});
  EXPECT_THAT(complaint(through), HasSubstr("crosses wall 'w1' at (1, 0) m"));
  SimulationInput empty = noisy_rooms(3);
  empty.world.walls.clear();
  EXPECT_THAT(complaint(empty), HasSubstr("no walls"));
  SimulationInput timeless = noisy_rooms(3);
  timeless.sensor.time_per_beam_s = 0.0;
  EXPECT_THAT(complaint(timeless), HasSubstr("time_per_beam_s is 0"));
  EXPECT_THROW(simulate(noisy_rooms(3), 0), InternalError);
}

TEST(Simulate, TheMemoryEstimateCoversTheRecordingAndGrowsWithIt) {
  const SimulationInput input = noisy_rooms(50);
  const std::uint64_t recording = 50ULL * 100ULL * (8 + 8 + 4);
  EXPECT_GE(memory_estimate(input), recording);
  EXPECT_LT(memory_estimate(input), 10 * recording);
  const std::uint64_t twice = memory_estimate(noisy_rooms(100));
  EXPECT_GT(twice - memory_estimate(input), recording);
}

}  // namespace
}  // namespace scanbench::sim
