// What pages say about bounds of sensors that move or are tilted.
#include "harness/results/figures/recording_note.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/study/scenario/scenario_file.hpp"

namespace scanbench::results {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string note_of(const std::string& trajectory, const std::string& metrics) {
  return bound_note(study::parse_scenario(
      "schema: 1\nworld: {segments: [[a, 0, 0, 4, 0]]}\nsensor: {preset: sick_pls101}\ntrajectory:\n"
      "  {kind: waypoints, points_m: {A: [1, 1], B: [3, 1]}, scans: 4, " +
          trajectory + "}\nmetrics: [" + metrics + "]\n",
      "s.yaml"));
}

TEST(BoundNote, SaysThatBoundsAreThoseOfAStillLevelSensor) {
  EXPECT_THAT(
      note_of("sweep: true", "efficiency"),
      AllOf(HasSubstr("still, level sensor"), HasSubstr("the sensor moves while it scans"), Not(HasSubstr("tilt"))));
  EXPECT_THAT(note_of("tilt: {roll_sigma_deg: 2}", "segments, pose_efficiency"), HasSubstr("the sensor is tilted"));
}

TEST(BoundNote, IsEmptyWhereABoundHolds) {
  EXPECT_EQ(note_of("sweep: false", "efficiency"), "");
  EXPECT_EQ(note_of("sweep: true", "segments"), "");
}

}  // namespace
}  // namespace scanbench::results
