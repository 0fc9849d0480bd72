// Agreement of placed scans, by hand.
#include "algorithms/align/parts/joint_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scanbench::align {
namespace {

constexpr double kGate = 0.4;
constexpr int kPoints = 11;

/// A wall 2 m ahead of the sensor, seen at points 0.1 m apart.
ScanShape wall_ahead() {
  ScanShape shape;
  const Segment wall{{2, -0.5}, {2, 0.5}};
  shape.lines.push_back(seen_from_origin(wall.a, wall.b));
  for (int k = 0; k < kPoints; ++k) shape.readings.push_back({{2, -0.5 + 0.1 * k}, shape.lines[0].direction()});
  return shape;
}

double agreement_at(const std::vector<Pose2>& poses) {
  const std::vector<ScanShape> shapes(poses.size(), wall_ahead());
  return agreement(shapes, {kGate, 0.1, 0.5}, 1.0, poses);
}

TEST(Agreement, OfCoincidingScansIsTheNumberOfPairs) {
  EXPECT_NEAR(agreement_at({{}, {}}), 2 * kPoints, 1e-9);
  EXPECT_NEAR(agreement_at({{}, {}, {}}), 6 * kPoints, 1e-9) << "every scan with both others";
  EXPECT_EQ(agreement_at({{}}), 0.0);
}

TEST(Agreement, FallsWithTheDistanceAndIsNothingFromTheGateOn) {
  const double u = 0.1 / kGate;
  EXPECT_NEAR(agreement_at({{}, {0.1, 0, 0}}), 2 * kPoints * std::pow(1 - u * u, 3), 1e-9);
  EXPECT_EQ(agreement_at({{}, {0.41, 0, 0}}), 0.0);
}

TEST(Agreement, DoesNotDependOnTheFrame) {
  const Pose2 elsewhere(30, -7, 2.0);
  EXPECT_NEAR(agreement_at({elsewhere, elsewhere * Pose2(0.1, 0.05, 0.02)}), agreement_at({{}, {0.1, 0.05, 0.02}}),
              1e-9);
}

}  // namespace
}  // namespace scanbench::align
