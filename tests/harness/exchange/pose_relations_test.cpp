// Relation files: which rows are read, in which frame, and what is refused.
#include "harness/exchange/pose_relations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/angles.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::harness {
namespace {

using testing::HasSubstr;

// Not in order of time, as recorded logs may be.
const std::vector<double> kStamps = {10.0, 12.0, 11.0};

std::vector<PoseRelation> relations(const std::string& text, const Pose2& robot_from_sensor = {}) {
  return parse_relations(text, "r.txt", kStamps, robot_from_sensor);
}

std::string refusal(const std::string& text) {
  return config_refusal([&] { relations(text); });
}

TEST(PoseRelations, AreBetweenTheFramesWithTheirStamps) {
  const auto found = relations(
      "# two of the log, one with another stamp\n"
      "10.0004 10.9996 1 2 0 0 0 0.5\n"
      "12 10 -1 0 0 0 0 -0.25 # back\n\n"
      "10 13 1 2 0 0 0 0.5\n");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].second, 2);
  EXPECT_EQ(found[0].first_from_second, Pose2(1, 2, 0.5));
  EXPECT_EQ(found[1].first, 1);
  EXPECT_EQ(found[1].second, 0);
}

TEST(PoseRelations, OfTheRobotBecomeThoseOfASensorOnIt) {
  // The robot turns by a quarter on the spot; a sensor 1 m ahead of its centre moves from (1, 0) to (0, 1).
  const auto found = relations("10 12 0 0 0 0 0 1.5707963267948966\n", {1, 0, 0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR((found[0].first_from_second.translation() - Vec2(-1, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(found[0].first_from_second.yaw(), kPi / 2, 1e-12);
}

TEST(PoseRelations, OutOfThePlaneCutShortOrOfAnotherLogAreRefused) {
  EXPECT_THAT(refusal("10 11 1 2 0 0 0 0.5\n10 11 1 2 0.1 0 0 0.5\n"), HasSubstr("r.txt:2:11: z is 0.1"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0.01 0.5\n"), HasSubstr("pitch is 0.01"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0\n"), HasSubstr("r.txt:1:1: 7 fields in a row"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0 nan\n"), HasSubstr("r.txt:1:17: yaw"));
  EXPECT_THAT(refusal("20 21 1 2 0 0 0 0\n"), HasSubstr("none of its 1 relations is between two scans of the log"));
  EXPECT_THAT(refusal(""), HasSubstr("none of its 0 relations"));
}

}  // namespace
}  // namespace scanbench::harness
