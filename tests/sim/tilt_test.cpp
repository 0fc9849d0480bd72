// Tilted scans against rays and planes in space, and the angles against their distribution.
#include "sim/tilt.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/params.hpp"
#include "core/recording.hpp"
#include "core/rng.hpp"
#include "sim/noise.hpp"
#include "sim/sensors.hpp"
#include "sim/simulate.hpp"
#include "tests/sim/test_worlds.hpp"

namespace scanbench::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kWidth = 8.0;
constexpr double kDepth = 6.0;

/// World direction of a beam at an angle in the sensor's plane.
Vector3d direction_in_space(double yaw, const TiltAngles& tilt, double angle) {
  const Eigen::Matrix3d world_from_sensor =
      (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(tilt.pitch_rad, Vector3d::UnitY()) *
       AngleAxisd(tilt.roll_rad, Vector3d::UnitX()))
          .toRotationMatrix();
  return world_from_sensor * Vector3d(std::cos(angle), std::sin(angle), 0.0);
}

struct Met {
  double range = test::kInf;
  bool floor = false;
};

/// The first plane of a box, without a lid and, for height 0, without a floor, that a ray from inside hits.
Met met_in_box(const Vector3d& from, const Vector3d& direction) {
  Met met;
  const auto plane = [&](int axis, double at, bool floor) {
    const double range = (at - from[axis]) / direction[axis];
    if (range > 0 && range < met.range) met = {range, floor};
  };
  plane(0, 0.0, false);
  plane(0, kWidth, false);
  plane(1, 0.0, false);
  plane(1, kDepth, false);
  if (from.z() > 0) plane(2, 0.0, true);
  return met;
}

SimulationInput box_input(int scans, const Tilt& tilt, double range_max_m, const ParamSet& noise = {}) {
  SimulationInput input;
  input.world = test::box_world(kWidth, kDepth);
  ParamSet params = {
      {"angle_min_deg", -180.0}, {"angle_step_deg", 5.0}, {"beams", std::int64_t{72}}, {"range_max_m", range_max_m}};
  params.insert(noise.begin(), noise.end());
  input.sensor = make_sensor("custom", params);
  CounterRng rng(17, RngStream::pose);
  for (int k = 0; k < scans; ++k) {
    const Vec2 place = test::uniform_point(rng, {0.5, 0.5}, {kWidth - 0.5, kDepth - 0.5});
    input.trajectory.poses.push_back({0.1 * k, Pose2(place, kTwoPi * rng.uniform())});
  }
  input.tilt = tilt;
  input.seed = 5;
  return input;
}

struct Counts {
  int walls = 0;
  int floor = 0;
  int wall_lost = 0;   // beams that return nothing, though a level one would
  int floor_lost = 0;  // beams whose floor is beyond the largest range
};

/// Compares every reading with the planes of the box.
Counts expect_readings_of_the_box(const SimulationInput& input) {
  const Recording recording = simulate(input, 2);
  Counts counts;
  for (std::size_t k = 0; k < recording.observed.frames.size(); ++k) {
    const auto frame = static_cast<std::uint32_t>(k);
    const TiltAngles tilt = tilt_angles(input.tilt, input.seed, frame);
    for (int i = 0; i < input.sensor.geometry.beams(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Pose2 pose = input.sweep ? pose_during_scan(input.trajectory, k, i * input.sensor.time_per_beam_s)
                                     : input.trajectory.poses[k].world_from_sensor;
      const double angle = input.sensor.geometry.angle(i) +
                           bearing_error(input.sensor.noise, {input.seed, frame, static_cast<std::uint32_t>(i)});
      const Met met =
          met_in_box({pose.x(), pose.y(), input.tilt.height_m}, direction_in_space(pose.yaw(), tilt, angle));
      const double reading = recording.observed.frames[k].ranges[at];
      if (met.range > input.sensor.range_max_m) {
        EXPECT_EQ(reading, test::kInf) << k << " " << i;
        if (met.floor)
          ++counts.floor_lost;
        else if (recording.truth->ranges[k * recording.observed.frames[k].ranges.size() + at] < test::kInf)
          ++counts.wall_lost;
      } else {
        EXPECT_NEAR(reading, met.range, 1e-9) << k << " " << i;
        ++(met.floor ? counts.floor : counts.walls);
      }
    }
  }
  return counts;
}

TEST(Tilt, RangesToUprightWallsAreThoseOfRaysAndPlanesInSpace) {
  const Counts counts = expect_readings_of_the_box(box_input(300, {0.25, 0.25, 0.0}, 7.0));
  EXPECT_GT(counts.walls, 10000);
  EXPECT_GT(counts.wall_lost, 100);
  EXPECT_EQ(counts.floor, 0);
}

TEST(Tilt, TheFloorIsHitWhereItIsNearerThanTheWall) {
  const Counts counts = expect_readings_of_the_box(box_input(300, {0.25, 0.25, 0.7}, 30.0));
  EXPECT_GT(counts.walls, 10000);
  EXPECT_GT(counts.floor, 3000);
}

TEST(Tilt, AFloorBeyondTheLargestRangeReturnsNothing) {
  const Counts counts = expect_readings_of_the_box(box_input(300, {0.25, 0.25, 0.7}, 3.5));
  EXPECT_GT(counts.floor, 1000);
  EXPECT_GT(counts.floor_lost, 100);
}

TEST(Tilt, WorksTogetherWithASweepAndBearingNoise) {
  SimulationInput input = box_input(100, {0.25, 0.25, 0.7}, 30.0,
                                    {{"bearing_sigma_deg", 2.0}, {"scan_period_s", 0.1}, {"time_per_beam_s", 0.001}});
  input.sweep = true;
  for (std::size_t k = 0; k < 100; ++k) {  // around the middle
    const double angle = 0.2 * static_cast<double>(k);
    const Vec2 place = Vec2(kWidth / 2, kDepth / 2) + 1.5 * test::unit(angle);
    input.trajectory.poses[k].world_from_sensor = Pose2(place, angle + kPi / 2);
  }
  const Counts counts = expect_readings_of_the_box(input);
  EXPECT_GT(counts.walls, 3000);
  EXPECT_GT(counts.floor, 1000);
}

TEST(Tilt, PointsOfTheFloorAreOnItAndPointsOfWallsAboveIt) {
  const SimulationInput input = box_input(100, {0.25, 0.25, 0.7}, 30.0);
  const Recording recording = simulate(input);
  int on_floor = 0;
  for (std::size_t k = 0; k < 100; ++k) {
    const Pose2& pose = input.trajectory.poses[k].world_from_sensor;
    const TiltAngles tilt = tilt_angles(input.tilt, input.seed, static_cast<std::uint32_t>(k));
    for (int i = 0; i < input.sensor.geometry.beams(); ++i) {
      const double range = recording.observed.frames[k].ranges[static_cast<std::size_t>(i)];
      const Vector3d point = Vector3d(pose.x(), pose.y(), 0.7) +
                             range * direction_in_space(pose.yaw(), tilt, input.sensor.geometry.angle(i));
      const double from_wall = std::min({point.x(), kWidth - point.x(), point.y(), kDepth - point.y()});
      EXPECT_GT(point.z(), -1e-9);
      EXPECT_GT(from_wall, -1e-9);
      EXPECT_LT(std::min(point.z(), from_wall), 1e-9);
      if (point.z() < 1e-9) ++on_floor;
    }
  }
  EXPECT_GT(on_floor, 1000);
}

TEST(Tilt, PositivePitchLowersTheNoseAndPositiveRollLiftsTheLeftSide) {
  const double angle = radians(10.0);
  EXPECT_NEAR(TiltRotation({.pitch_rad = angle}).beam({1, 0}).up, -std::sin(angle), 1e-15);
  EXPECT_NEAR(TiltRotation({.pitch_rad = angle}).beam({0, 1}).up, 0.0, 1e-15);
  EXPECT_NEAR(TiltRotation({.roll_rad = angle}).beam({0, 1}).up, std::sin(angle), 1e-15);
  EXPECT_NEAR(TiltRotation({.roll_rad = angle}).beam({1, 0}).up, 0.0, 1e-15);
}

// A panel whose end is straight ahead at 3 m and a wall at 9 m behind it; all surfaces cross the heading at right
// angles. Under a pitch p all ranges along a beam grow by 1 / cos p.
SimulationInput depth_edge(const Tilt& tilt, double range_max_m) {
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.world.walls.push_back({"panel", {{4, 5}, {4, 8}}});
  input.sensor = make_sensor(
      "custom",
      {{"angle_min_deg", 0.0}, {"beams", std::int64_t{1}}, {"range_max_m", range_max_m}, {"beam_divergence_deg", 0.5}});
  for (int k = 0; k < 1000; ++k) input.trajectory.poses.push_back({0.1 * k, Pose2(1, 5, 0)});
  input.tilt = tilt;
  return input;
}

struct Mixtures {
  int with_wall = 0;
  int with_floor = 0;
  int panel = 0;
  int floor = 0;
};

/// Compares every reading at the depth edge with the share that the level sensor's readings have of the wall behind.
Mixtures expect_mixtures(const Tilt& tilt, double range_max_m) {
  const Recording level = simulate(depth_edge({}, 30.0));
  const Recording tilted = simulate(depth_edge(tilt, range_max_m));
  const double edge = std::cos(radians(0.25));
  Mixtures mixtures;
  for (std::size_t k = 0; k < 1000; ++k) {
    const double pitch = tilt_angles(tilt, 1, static_cast<std::uint32_t>(k)).pitch_rad;
    const double share = (level.observed.frames[k].ranges[0] * edge - 3.0) / 6.0;
    const double panel = 3.0 / (edge * std::cos(pitch));
    const double wall = 9.0 / (edge * std::cos(pitch));
    const double floor = pitch > 0 && tilt.height_m > 0 ? tilt.height_m / (edge * std::sin(pitch)) : test::kInf;
    const double behind = std::min(wall, floor);
    const double reading = tilted.observed.frames[k].ranges[0];
    if (floor < panel) {
      EXPECT_NEAR(reading, floor * edge, 1e-9);
      ++mixtures.floor;
    } else if (behind > range_max_m) {
      EXPECT_NEAR(reading, panel * edge, 1e-9);
      ++mixtures.panel;
    } else if (behind - panel > radians(0.5) * panel) {
      EXPECT_NEAR(reading, panel + share * (behind - panel), 1e-9);
      ++(floor < wall ? mixtures.with_floor : mixtures.with_wall);
    }
  }
  return mixtures;
}

TEST(Tilt, AMixedPixelIsBetweenTheTwoSurfacesAlongTheBeam) {
  const Mixtures mixtures = expect_mixtures({.pitch_sigma_rad = 0.2}, 9.5);
  EXPECT_GT(mixtures.with_wall, 500);
  EXPECT_GT(mixtures.panel, 50);  // the wall behind is out of reach, along the beam
}

TEST(Tilt, AMixedPixelMayHaveTheFloorBehindThePanel) {
  const Mixtures mixtures = expect_mixtures({.pitch_sigma_rad = 0.2, .height_m = 0.6}, 5.0);
  EXPECT_GT(mixtures.with_floor, 50);
  EXPECT_GT(mixtures.panel, 50);  // the floor is out of reach
  EXPECT_GT(mixtures.floor, 50);
}

TEST(Tilt, DropOutFollowsTheIncidenceInSpace) {
  SimulationInput input;
  input.world = test::box_world(10, 10);
  input.sensor = make_sensor(
      "custom", {{"angle_min_deg", 0.0}, {"beams", std::int64_t{1}}, {"range_max_m", 1e6}, {"dropout_grazing", 1.0}});
  for (int k = 0; k < 4000; ++k) input.trajectory.poses.push_back({0.1 * k, Pose2(5, 5, 0)});
  input.tilt = {.pitch_sigma_rad = 0.4, .height_m = 1.0};
  const Recording recording = simulate(input);
  double expected = 0.0;
  double variance = 0.0;
  int dropped = 0;
  for (std::size_t k = 0; k < 4000; ++k) {
    const double pitch = tilt_angles(input.tilt, 1, static_cast<std::uint32_t>(k)).pitch_rad;
    const bool floor = pitch > std::atan2(1.0, 5.0);
    const double probability = std::pow(1.0 - (floor ? std::sin(pitch) : std::cos(pitch)), 2);
    expected += probability;
    variance += probability * (1.0 - probability);
    if (recording.observed.frames[k].ranges[0] == test::kInf) ++dropped;
  }
  EXPECT_NEAR(dropped, expected, 5.0 * std::sqrt(variance));
}

TEST(Tilt, AnglesAreNormalIndependentAndHaveTheirDeviations) {
  constexpr int kScans = 100000;
  const Tilt tilt{.roll_sigma_rad = 0.02, .pitch_sigma_rad = 0.05};
  double roll = 0.0;
  double pitch = 0.0;
  double roll2 = 0.0;
  double pitch2 = 0.0;
  double product = 0.0;
  double roll4 = 0.0;
  for (std::uint32_t k = 0; k < kScans; ++k) {
    const TiltAngles angles = tilt_angles(tilt, 3, k);
    const double r = angles.roll_rad / 0.02;
    const double p = angles.pitch_rad / 0.05;
    roll += r;
    pitch += p;
    roll2 += r * r;
    pitch2 += p * p;
    product += r * p;
    roll4 += r * r * r * r;
  }
  const double mean_error = 5.0 / std::sqrt(kScans);
  const double deviation_error = 5.0 / std::sqrt(2.0 * kScans);
  EXPECT_NEAR(roll / kScans, 0.0, mean_error);
  EXPECT_NEAR(pitch / kScans, 0.0, mean_error);
  EXPECT_NEAR(std::sqrt(roll2 / kScans), 1.0, deviation_error);
  EXPECT_NEAR(std::sqrt(pitch2 / kScans), 1.0, deviation_error);
  EXPECT_NEAR(product / kScans, 0.0, mean_error);
  EXPECT_NEAR(roll4 / kScans, 3.0, 5.0 * std::sqrt(96.0 / kScans));  // of a normal: variance of x^4 is 105 - 9
}

TEST(Tilt, EnablingOneAngleDoesNotChangeTheOther) {
  const TiltAngles both = tilt_angles({0.1, 0.2, 0}, 3, 4);
  const TiltAngles pitch_only = tilt_angles({0.0, 0.2, 0}, 3, 4);
  EXPECT_EQ(pitch_only.pitch_rad, both.pitch_rad);
  EXPECT_EQ(pitch_only.roll_rad, 0.0);
  EXPECT_EQ(tilt_angles({0.1, 0.0, 0}, 3, 4).roll_rad, both.roll_rad);
}

bool same_doubles(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(Tilt, ALevelSensorReadsTheSameBytesAtAnyHeight) {
  const ParamSet noise = {{"bearing_sigma_deg", 1.0}, {"beam_divergence_deg", 0.5}, {"sigma_m", 0.02}};
  const Recording without = simulate(box_input(20, {}, 30.0, noise));
  const Recording level = simulate(box_input(20, {.height_m = 0.1}, 30.0, noise));
  for (std::size_t k = 0; k < 20; ++k)
    EXPECT_TRUE(same_doubles(level.observed.frames[k].ranges, without.observed.frames[k].ranges)) << k;
}

TEST(Tilt, MovesReadingsAndNeitherTheTruthNorTheOdometry) {
  SimulationInput input = box_input(20, {}, 30.0);
  input.odometry.pose_position_sigma_m = 0.05;
  const Recording level = simulate(input);
  input.tilt = {0.05, 0.05, 1.0};
  const Recording tilted = simulate(input);
  EXPECT_TRUE(same_doubles(tilted.truth->ranges, level.truth->ranges));
  EXPECT_EQ(tilted.truth->wall_ids, level.truth->wall_ids);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(tilted.observed.frames[k].odom_from_sensor, level.observed.frames[k].odom_from_sensor);
    EXPECT_FALSE(same_doubles(tilted.observed.frames[k].ranges, level.observed.frames[k].ranges));
  }
}

}  // namespace
}  // namespace scanbench::sim
