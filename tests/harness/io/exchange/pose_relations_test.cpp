// Relation files: which rows are read, in which frame, and what is refused.
#include "harness/io/exchange/pose_relations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/angles.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

using testing::HasSubstr;

// Not in order of time, as recorded logs may be.
const std::vector<double> kStamps = {10.0, 12.0, 11.0};

std::vector<PoseRelation> relations(const std::string& text, const Pose2& robot_from_sensor = {}) {
  const std::vector<Pose2> poses(kStamps.size());
  return parse_relations(text, "r.txt", {kStamps, poses, 1, kStamps.size()}, robot_from_sensor);
}

std::string refusal(const std::string& text) {
  return support::config_refusal([&] { relations(text); });
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

/// Scans a second and a metre apart on a bent path, of which every n-th is read.
RelatedScans bent_path(std::size_t scans, std::size_t every) {
  RelatedScans path;
  path.every = every;
  path.frames = (scans + every - 1) / every;
  for (std::size_t k = 0; k < scans; ++k) {
    const auto t = static_cast<double>(k);
    path.stamps_s.push_back(t);
    path.world_from_sensor.emplace_back(t, 0.1 * t * t, 0.05 * t);
  }
  return path;
}

Pose2 motion(const RelatedScans& path, std::size_t i, std::size_t j) {
  return path.world_from_sensor[i].inverse() * path.world_from_sensor[j];
}

std::string row(const std::string& name, const Pose2& p) {
  return name + " " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.yaw()) + "\n";
}

TEST(PoseRelations, AreReadFromTheEdgesOfAGraphLog) {
  const auto found = parse_relations(
      "VERTEX2 0 1 2 3\nROBOTLASER1 0 1\nEDGE2 3 7 0.5 -0.25 1.5 1 0 0 1 0 1\n#LOOP EDGES\nEDGE2 7 1 2 0 0\n", "r.txt",
      bent_path(9, 1), {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 3);
  EXPECT_EQ(found[0].second, 7);
  EXPECT_EQ(found[0].first_from_second, Pose2(0.5, -0.25, 1.5));
  EXPECT_EQ(found[1].first, 7);
}

TEST(PoseRelations, OfScansThatAreNotReadMoveToTheNearestThatAre) {
  const RelatedScans path = bent_path(20, 5);  // 0, 5, 10, 15 are read
  const auto found = parse_relations(row("EDGE2 6 13", motion(path, 6, 13)), "r.txt", path, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 1);
  EXPECT_EQ(found[0].second, 3);
  const Pose2 expected = motion(path, 5, 15);  // the edge agrees with the poses of the log
  EXPECT_NEAR((found[0].first_from_second.translation() - expected.translation()).norm(), 0.0, 1e-5);
  EXPECT_NEAR(found[0].first_from_second.yaw(), expected.yaw(), 1e-5);
}

TEST(PoseRelations, WithinOneFrameOrBeyondTheLastAreSkipped) {
  const RelatedScans path = bent_path(19, 5);
  const std::string text = "EDGE2 0 10 1 0 0\nEDGE2 9 11 1 0 0\nEDGE2 0 18 1 0 0\n400 500 1 0 0 0 0 0\n";
  const auto found = parse_relations(text, "r.txt", path, {});
  ASSERT_EQ(found.size(), 1U) << "9 and 11 are both nearest to 10; 18 is nearest to 20, which does not exist";
  EXPECT_EQ(found[0].second, 2);
}

TEST(PoseRelations, OfScansThatAreNotReadAreSkippedInALogWithoutPoses) {
  RelatedScans path = bent_path(20, 5);
  path.world_from_sensor.assign(path.stamps_s.size(), Pose2());
  const auto found = parse_relations("EDGE2 6 13 1 0 0\nEDGE2 5 15 1 0 0\n", "r.txt", path, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first_from_second, Pose2(1, 0, 0));
}

TEST(PoseRelations, OutOfThePlaneCutShortOrOfAnotherLogAreRefused) {
  EXPECT_THAT(refusal("10 11 1 2 0 0 0 0.5\n10 11 1 2 0.1 0 0 0.5\n"), HasSubstr("r.txt:2:11: z is 0.1"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0.01 0.5\n"), HasSubstr("pitch is 0.01"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0\n"), HasSubstr("r.txt:1:1: 7 fields in a row"));
  EXPECT_THAT(refusal("10 11 1 2 0 0 0 nan\n"), HasSubstr("r.txt:1:17: yaw"));
  EXPECT_THAT(refusal("EDGE2 0 3 1 2 0\n"), HasSubstr("r.txt:1:9: '3' is not a scan of the log; allowed: 0 to 2"));
  EXPECT_THAT(refusal("EDGE2 0 1 1 2\n"), HasSubstr("an EDGE2 row of 5 words"));
  EXPECT_THAT(refusal("EDGE2 0 1 1 oops 0\n"), HasSubstr("r.txt:1:13: y"));
  EXPECT_THAT(refusal("20 21 1 2 0 0 0 0\n"), HasSubstr("none of its 1 relations is between two scans of the log"));
  EXPECT_THAT(refusal(""), HasSubstr("none of its 0 relations"));
}

}  // namespace
}  // namespace scanbench::io
