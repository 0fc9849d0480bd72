// Recorded logs with relations and errors of their poses; the logs of the scenarios of Lakaemper 2010.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/index.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::runs {
namespace {

using testing::HasSubstr;

/// A log of three scans a metre apart, and a relation that disagrees with their poses.
std::filesystem::path scenario_with(const support::TemporaryFolder& folder, const std::string& more) {
  std::string log;
  for (const char* x : {"0", "1", "2"}) {
    log += "FLASER 180";
    for (int i = 0; i < 180; ++i) log += " 2.5";
    log += std::string(" ") + x + " 0 0 0 0 0 10" + x + " host 0\n";
  }
  folder.write("l.log", log);
  folder.write("r.txt", "100 101 1.5 0 0 0 0 0\n");
  return folder.write("s.yaml", "schema: 1\nrecording: {log: l.log, format: carmen, no_return_m: 0, " + more + "}\n");
}

Pose2 given_pose(const Recording& recording, std::size_t frame) {
  return recording.observed.frames[frame].odom_from_sensor;
}

TEST(RecordedLog, GetsErrorsOfItsPosesThatFollowTheSeed) {
  const support::TemporaryFolder folder;
  const study::Scenario scenario = study::load_scenario(
      scenario_with(folder, "relations: r.txt, odometry: {pose_position_sigma_m: 0.2, pose_heading_sigma_deg: 3}"));
  const Recording one = make_recording(scenario, 1, 1), two = make_recording(scenario, 2, 1);
  ASSERT_TRUE(one.reference);
  ASSERT_EQ(one.reference->relations.size(), 1U);
  EXPECT_EQ(one.reference->relations[0].first_from_second, Pose2(1.5, 0, 0)) << "a relation gets no error";
  EXPECT_EQ(given_pose(one, 0), Pose2(0, 0, 0)) << "the first pose has no error";
  EXPECT_NE(given_pose(one, 1), Pose2(1, 0, 0));
  EXPECT_LT((given_pose(one, 1).translation() - Vec2(1, 0)).norm(), 1.5) << "five standard deviations";
  EXPECT_NE(given_pose(one, 1), given_pose(two, 1));
  EXPECT_EQ(given_pose(one, 2), given_pose(make_recording(scenario, 1, 1), 2));
}

TEST(RecordedLog, KeepsThePosesToCompareWithFreeOfErrors) {
  const support::TemporaryFolder folder;
  const Recording recording = make_recording(
      study::load_scenario(scenario_with(folder, "compare_poses: reference, odometry: {pose_heading_sigma_deg: 3}")), 1,
      1);
  ASSERT_TRUE(recording.reference);
  EXPECT_EQ(recording.reference->world_from_sensor[1], Pose2(1, 0, 0));
  EXPECT_NE(given_pose(recording, 1), Pose2(1, 0, 0));
}

TEST(RecordedLog, KeepsErrorsInTheEffectiveScenario) {
  const support::TemporaryFolder folder;
  const study::Scenario scenario =
      study::load_scenario(scenario_with(folder, "relations: r.txt, odometry: {pose_heading_sigma_deg: 3}"));
  folder.write("e.yaml", study::effective_yaml(scenario));
  const study::Scenario again = study::load_scenario(folder.path() / "e.yaml");
  EXPECT_EQ(study::effective_yaml(again), study::effective_yaml(scenario));
  EXPECT_EQ(recording_hash(make_recording(again, 4, 1)), recording_hash(make_recording(scenario, 4, 1)));
}

TEST(RecordedLog, TakesSeveralSeedsOnlyIfItsPosesGetErrors) {
  const support::TemporaryFolder folder;
  const auto with_errors = scenario_with(folder, "odometry: {pose_heading_sigma_deg: 3}");
  EXPECT_EQ(study::load_scenario(with_errors, {"seeds=[1, 2]"}).seeds.size(), 2U);
  EXPECT_TRUE(study::has_chance(study::load_scenario(with_errors)));
  const auto without = scenario_with(folder, "every: 1");
  EXPECT_THAT(support::config_refusal([&] { study::load_scenario(without, {"seeds=[1, 2]"}); }),
              HasSubstr("allowed: one seed"));
  EXPECT_FALSE(study::has_chance(study::load_scenario(without)));
}

/// Mean deviation of the poses of the log itself from its relations, after a shipped scenario was read without errors.
double mean_deviation_m(const std::string& name, std::size_t frames, std::size_t least_relations) {
  setenv("SCANBENCH_DATA", support::data_dir().c_str(), 0);
  const study::Scenario scenario = study::load_scenario(
      support::source_dir() / "scenarios/logs" / (name + ".yaml"),
      {"recording.odometry.pose_position_sigma_m=0", "recording.odometry.pose_heading_sigma_deg=0", "seeds=[1]"});
  const Recording recording = make_recording(scenario, 1, 1);
  EXPECT_EQ(recording.observed.frames.size(), frames);
  EXPECT_GE(recording.reference->relations.size(), least_relations);
  double sum = 0.0;
  for (const PoseRelation& r : recording.reference->relations) {
    const Pose2 step = given_pose(recording, as_index(r.first)).inverse() * given_pose(recording, as_index(r.second));
    sum += (step.translation() - r.first_from_second.translation()).norm();
  }
  return sum / static_cast<double>(recording.reference->relations.size());
}

// The provenance of the data states that the poses of the log and the relations agree to 2.9 cm on average.
TEST(RecordedLog, OfTheIntelLabHasRelationsBetweenSparseScans) {
  if (!std::filesystem::exists(support::data_dir() / "intel-graph")) GTEST_SKIP() << "intel-graph is not there";
  EXPECT_LT(mean_deviation_m("lakaemper2010_intel", 268, 90), 0.05);  // 90: counted in the files
}

TEST(RecordedLog, OfCsailHasRelationsBetweenSparseScans) {
  if (!std::filesystem::exists(support::data_dir() / "csail-graph")) GTEST_SKIP() << "csail-graph is not there";
  EXPECT_LT(mean_deviation_m("lakaemper2010_csail", 211, 50), 0.05);
}

}  // namespace
}  // namespace scanbench::runs
