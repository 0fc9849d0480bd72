// Superimposed copies of walls: exact lines, random poses and their deviations.
#include "sim/line_copies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/recording.hpp"

namespace scanbench::sim {
namespace {

World two_walls() {
  World world;
  world.name = "w";
  world.walls = {{"a", {{0, 0}, {1, 0}}}, {"b", {{2, 3}, {2, 5}}}};
  return world;
}

const World kTwoWalls = two_walls();

TEST(LineCopies, AreTheWallsAtPosesThatDiffer) {
  const Recording r = line_copies(kTwoWalls, {.copies = 5, .rotation_sigma_rad = 0.02, .shift_sigma_m = 0.03}, 7);
  ASSERT_EQ(r.observed.frames.size(), 5U);
  ASSERT_TRUE(r.truth);
  EXPECT_EQ(r.truth->walls.size(), 2U);
  EXPECT_EQ(r.truth->world_from_sensor, std::vector<Pose2>(5));
  EXPECT_TRUE(r.observed.has_given_lines());
  for (std::size_t k = 0; k < 5; ++k) {
    const Frame& frame = r.observed.frames[k];
    EXPECT_TRUE(frame.ranges.empty());
    EXPECT_EQ(frame.lines, (std::vector<Segment>{kTwoWalls.walls[0].segment, kTwoWalls.walls[1].segment}));
    for (std::size_t i = 0; i < k; ++i) EXPECT_NE(frame.odom_from_sensor, r.observed.frames[i].odom_from_sensor);
  }
}

TEST(LineCopies, WithoutErrorsCoincide) {
  for (const Frame& frame : line_copies(kTwoWalls, {.copies = 3}, 1).observed.frames)
    EXPECT_EQ(frame.odom_from_sensor, Pose2());
}

// More copies do not move the first ones.
TEST(LineCopies, DependOnTheSeedAndTheirNumberAlone) {
  const LineCopies few{.copies = 2, .rotation_sigma_rad = 0.1, .shift_sigma_m = 0.1};
  LineCopies many = few;
  many.copies = 9;
  const auto pose = [](const LineCopies& copies, std::uint64_t seed) {
    return line_copies(kTwoWalls, copies, seed).observed.frames[1].odom_from_sensor;
  };
  EXPECT_EQ(pose(few, 3), pose(many, 3));
  EXPECT_NE(pose(few, 3), pose(few, 4));
}

TEST(LineCopies, HaveTheRequestedStandardDeviations) {
  constexpr int kCopies = 4000;
  const LineCopies copies{.copies = kCopies, .rotation_sigma_rad = 0.02, .shift_sigma_m = 0.5};
  double x = 0, y = 0, turn = 0;
  for (const Frame& frame : line_copies(kTwoWalls, copies, 11).observed.frames) {
    x += std::pow(frame.odom_from_sensor.x(), 2);
    y += std::pow(frame.odom_from_sensor.y(), 2);
    turn += std::pow(frame.odom_from_sensor.yaw(), 2);
  }
  const double five_standard_errors = 5.0 / std::sqrt(2.0 * kCopies);
  EXPECT_NEAR(std::sqrt(x / kCopies) / 0.5, 1.0, five_standard_errors);
  EXPECT_NEAR(std::sqrt(y / kCopies) / 0.5, 1.0, five_standard_errors);
  EXPECT_NEAR(std::sqrt(turn / kCopies) / 0.02, 1.0, five_standard_errors);
}

TEST(LineCopies, NeedAWorldWithWalls) {
  EXPECT_THROW(line_copies({}, {.copies = 2}, 1), ConfigError);
}

}  // namespace
}  // namespace scanbench::sim
