// Matches with the last scan but one: which, from which guesses, and what they leave as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/summary.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Finds the guess, or a metre ahead if that is no motion, and is sure of it.
class GuessedMatch final : public ScanMatcher {
 public:
  using Params = NoParams;
  explicit GuessedMatch(const Params&) {}
  Match match(const Observation&, const Observation&, const Pose2& guess, Trace&) const override {
    return {.reference_from_current = guess == Pose2() ? Pose2(1, 0, 0) : guess,
            .covariance = 1e-6 * Eigen::Matrix3d::Identity()};
  }
};
const bool kGuessedRegistered = Registry<ScanMatcher>::add<GuessedMatch>(
    {.name = "test_guessed_match", .summary = "of the tests", .reference = "none"});

study::PipelineSpec matching_with(const std::string& module) {
  study::PipelineSpec pipeline = fixtures::extract_with("p", "test_line");
  pipeline.slots.push_back({"match", module, {}});
  return pipeline;
}

std::vector<int> frames_of(const std::vector<FrameMatch>& matches) {
  std::vector<int> frames;
  for (const FrameMatch& match : matches) {
    EXPECT_EQ(match.reference, match.frame - 2);
    frames.push_back(match.frame);
  }
  return frames;
}

TEST(SkipMatches, AreAsManyAsRequestedAndSpreadEvenly) {
  ASSERT_TRUE(kGuessedRegistered);
  const Recording recording = fixtures::random_recording(1, 12, 16, false);
  const auto matched = [&](int most) {
    const PipelineRun run = run_pipeline(matching_with("test_ahead"), recording.observed, nullptr, {}, most);
    return frames_of(run.result.skip_matches);
  };
  EXPECT_THAT(matched(0), ElementsAre());
  EXPECT_THAT(matched(1), ElementsAre(2));
  EXPECT_THAT(matched(4), ElementsAre(2, 5, 8, 11));
  EXPECT_EQ(matched(10).size(), 10u);
  EXPECT_EQ(matched(1000).size(), 10u);
}

TEST(SkipMatches, StartFromTheOdometryBetweenTheirScans) {
  const Recording recording = fixtures::random_recording(1, 5, 16, false);
  const PipelineRun run = run_pipeline(matching_with("test_guessed_match"), recording.observed, nullptr, {}, 10);
  ASSERT_EQ(run.result.skip_matches.size(), 3u);
  for (const FrameMatch& match : run.result.skip_matches) {
    const auto k = static_cast<std::size_t>(match.frame);
    const Pose2 odometry =
        recording.observed.frames[k - 2].odom_from_sensor.inverse() * recording.observed.frames[k].odom_from_sensor;
    EXPECT_NEAR((match.match.reference_from_current.translation() - odometry.translation()).norm(), 0.0, 1e-12);
  }
}

TEST(SkipMatches, WithoutOdometryTheSensorGoesOnForTwoSteps) {
  ScanSet scans = fixtures::random_recording(1, 5, 16, false).observed;
  for (Frame& frame : scans.frames) frame.odom_from_sensor = Pose2(1, 2, 0.5);
  const PipelineRun run = run_pipeline(matching_with("test_guessed_match"), scans, nullptr, {}, 10);
  std::vector<double> ahead;
  for (const FrameMatch& match : run.result.skip_matches) ahead.push_back(match.match.reference_from_current.x());
  EXPECT_THAT(ahead, ElementsAre(1.0, 2.0, 2.0)) << "before the third scan nothing has moved";
}

TEST(SkipMatches, ChangeNeitherPosesNorTimesNorRemarks) {
  const Recording recording = fixtures::random_recording(1, 8, 16, false);
  const PipelineRun without = run_pipeline(matching_with("test_ahead"), recording.observed);
  const PipelineRun with = run_pipeline(matching_with("test_ahead"), recording.observed, nullptr, {}, 100);
  EXPECT_EQ(with.result.world_from_sensor, without.result.world_from_sensor);
  EXPECT_EQ(with.result.matches.size(), without.result.matches.size());
  EXPECT_EQ(with.result.times.size(), without.result.times.size());
  EXPECT_EQ(with.remarks, without.remarks);
}

TEST(SkipMatches, AreMadeIfAMetricRequestsThemAndScoredAgainFromTheirFile) {
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  study::Scenario scenario = fixtures::scenario_with("s", {matching_with("test_guessed_match")});
  scenario.metrics = {{"metrics", "closure", {{"triples", std::int64_t{2}}}}};
  EXPECT_EQ(skip_matches_requested(scenario.metrics), 2);
  fixtures::run_here({scenario}, {.out = run});
  const fs::path cell = cell_path(run, {"s", "p", 1});
  EXPECT_THAT(frames_of(load_result(cell).skip_matches), ElementsAre(2, 4));
  const std::string summary = io::read_file(run / "summary.csv");
  EXPECT_THAT(summary, HasSubstr("s,p,1,closure_over,all,0,,2\n")) << "odometry closes";
  score_run(run, {scenario});
  EXPECT_EQ(io::read_file(run / "summary.csv"), summary);

  scenario.metrics = {{"metrics", "test_metrics", {}}};
  fixtures::run_here({scenario}, {.out = folder.path() / "other"});
  EXPECT_FALSE(fs::exists(cell_path(folder.path() / "other", {"s", "p", 1}) / "skip_matches.csv"));
}

}  // namespace
}  // namespace scanbench::runs
