// Predicted poses with and without odometry.
#include "algorithms/map/parts/prediction.hpp"

#include <gtest/gtest.h>

#include "core/special_values.hpp"

namespace scanbench::mapping {
namespace {

void expect_pose(const Pose2& found, const Pose2& expected) {
  EXPECT_NEAR((found.translation() - expected.translation()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(wrap_angle(found.yaw() - expected.yaw()), 0.0, 1e-12);
}

/// Feeds one scan and says where it was found.
Prediction::Expected feed(Prediction& prediction, const Pose2& given, double stamp, const Pose2& found) {
  const auto expected = prediction.next(given, stamp);
  prediction.found(found);
  return expected;
}

TEST(Prediction, TheFirstScanIsAtTheOriginOfTheMap) {
  Prediction prediction(PredictionKind::odometry);
  expect_pose(prediction.next({7, 8, 1}, 0).map_from_sensor, {});
}

TEST(Prediction, OdometryAddsTheMotionBetweenTheGivenPoses) {
  Prediction prediction(PredictionKind::odometry);
  feed(prediction, {10, 0, 0}, 0, {});
  feed(prediction, {11, 0, 0}, 1, {0.9, 0.1, kPi / 2});  // found turned: the next metre goes to the left
  expect_pose(prediction.next({12, 0, 0}, 2).map_from_sensor, {0.9, 1.1, kPi / 2});
}

TEST(Prediction, ConstantPoseIsThePoseOfTheLastScan) {
  Prediction prediction(PredictionKind::constant_pose);
  feed(prediction, {10, 0, 0}, 0, {});
  feed(prediction, {11, 0, 0}, 1, {0.9, 0.1, 0.2});
  expect_pose(prediction.next({12, 0, 0}, 2).map_from_sensor, {0.9, 0.1, 0.2});
}

TEST(Prediction, ConstantVelocityGoesOnInProportionToTime) {
  Prediction prediction(PredictionKind::constant_velocity);
  feed(prediction, {}, 10, {});
  feed(prediction, {}, 11, {0.5, 0, 0});
  expect_pose(prediction.next({}, 13).map_from_sensor, {1.5, 0, 0});
}

TEST(Prediction, ConstantVelocityWithoutStampsRepeatsTheLastStep) {
  Prediction prediction(PredictionKind::constant_velocity);
  feed(prediction, {}, 0, {});
  feed(prediction, {}, 0, {0.5, 0, 0.1});
  expect_pose(prediction.next({}, 0).map_from_sensor, Pose2(0.5, 0, 0.1) * Pose2(0.5, 0, 0.1));
}

TEST(Prediction, TimeThatRunsBackwardsIsNoMotionAndIsReported) {
  Prediction prediction(PredictionKind::constant_velocity);
  feed(prediction, {}, 10, {});
  feed(prediction, {}, 11, {0.5, 0, 0});
  const auto expected = prediction.next({}, 10.5);
  expect_pose(expected.map_from_sensor, {0.5, 0, 0});
  EXPECT_EQ(expected.remark, "time runs backwards");
}

TEST(Prediction, AGivenPoseThatIsNotFiniteIsNoMotionAndIsReported) {
  Prediction prediction(PredictionKind::odometry);
  feed(prediction, {1, 0, 0}, 0, {});
  const auto expected = prediction.next(Pose2(kNaN, 0, 0), 1);
  expect_pose(expected.map_from_sensor, {});
  EXPECT_NE(expected.remark, "");
}

}  // namespace
}  // namespace scanbench::mapping
