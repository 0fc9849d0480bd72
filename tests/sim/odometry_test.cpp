// Odometry errors against the statistics of a random walk.
#include "sim/odometry.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/pose2.hpp"

namespace scanbench::sim {
namespace {

// A straight drive of `metres` in `steps`, rotating by `turn_rad` in total.
std::vector<Pose2> straight(double metres, int steps, double turn_rad = 0.0) {
  std::vector<Pose2> poses;
  for (int i = 0; i <= steps; ++i) poses.emplace_back(metres * i / steps, 0.0, turn_rad * i / steps);
  return poses;
}

struct Spread {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

constexpr int kRuns = 4000;

// Root mean square error of the last pose over many seeds.
Spread last_pose_rms(const std::vector<Pose2>& truth, const OdometryNoise& noise) {
  Spread sum;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Pose2 last = odometry_poses(truth, noise, static_cast<std::uint64_t>(seed)).back();
    sum.x += std::pow(last.x() - truth.back().x(), 2);
    sum.y += std::pow(last.y() - truth.back().y(), 2);
    sum.yaw += std::pow(wrap_angle(last.yaw() - truth.back().yaw()), 2);
  }
  return {std::sqrt(sum.x / kRuns), std::sqrt(sum.y / kRuns), std::sqrt(sum.yaw / kRuns)};
}

// Five standard errors of a standard deviation from kRuns samples.
double tolerance(double sigma) {
  return 5.0 * sigma / std::sqrt(2.0 * kRuns);
}

TEST(Odometry, WithoutNoiseIsTheTruthBitForBit) {
  const auto truth = straight(10, 7, 1.0);
  EXPECT_EQ(odometry_poses(truth, {}, 3), truth);
  EXPECT_TRUE(odometry_poses({}, {}, 3).empty());
}

TEST(Odometry, TheFirstPoseIsTrueUnderAllNoise) {
  const auto truth = straight(10, 7, 1.0);
  const auto odometry = odometry_poses(truth, {0.1, 0.1, 0.1, 0.1, 0.1}, 3);
  EXPECT_EQ(odometry.front(), truth.front());
  EXPECT_NE(odometry[1], truth[1]);
}

TEST(Odometry, DriftGrowsWithTheRootOfTheDistanceAndNotWithTheNumberOfScans) {
  for (const int steps : {4, 64}) {
    const Spread one = last_pose_rms(straight(1.0, steps), {.translation_per_m = 0.02});
    EXPECT_NEAR(one.x, 0.02, tolerance(0.02));
    EXPECT_EQ(one.y, 0.0);
    const Spread nine = last_pose_rms(straight(9.0, steps), {.translation_per_m = 0.02});
    EXPECT_NEAR(nine.x, 0.06, tolerance(0.06));
  }
}

TEST(Odometry, TheHeadingDriftsWithDistanceAndWithRotation) {
  EXPECT_NEAR(last_pose_rms(straight(4.0, 16), {.rotation_per_m_rad = 0.01}).yaw, 0.02, tolerance(0.02));
  EXPECT_NEAR(last_pose_rms(straight(0.0, 16, 2.25), {.rotation_per_rad = 0.04}).yaw, 0.06, tolerance(0.06));
  EXPECT_EQ(last_pose_rms(straight(0.0, 16), {.rotation_per_rad = 0.04}).yaw, 0.0);
}

TEST(Odometry, PosesThatAreSetByHandErrIndependently) {
  const Spread spread =
      last_pose_rms(straight(9.0, 16), {.pose_position_sigma_m = 0.05, .pose_heading_sigma_rad = 0.03});
  EXPECT_NEAR(spread.x, 0.05, tolerance(0.05));
  EXPECT_NEAR(spread.y, 0.05, tolerance(0.05));
  EXPECT_NEAR(spread.yaw, 0.03, tolerance(0.03));
}

}  // namespace
}  // namespace scanbench::sim
