// Pipelines: contract of the lines, parameters, stages and their times.
#include "harness/runs/execute/pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cfenv>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/runs/execute/stopwatch.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const Recording& recording() {
  static const Recording made = fixtures::random_recording(5, 6, 24, false);
  return made;
}

PipelineRun run_slots(const std::vector<std::pair<std::string, std::string>>& slots, Journal* journal = nullptr) {
  study::PipelineSpec pipeline;
  pipeline.name = "p";
  for (const auto& [kind, module] : slots) pipeline.slots.push_back({kind, module, {}});
  return run_pipeline(pipeline, recording().observed, journal);
}

/// A line that breaks the contract in one point.
class FaultyLine final : public LineExtractor {
 public:
  struct Params {
    int fault = 0;
    static auto fields() { return std::tuple{field("fault", &Params::fault, at_least(0), "", "which")}; }
  };
  explicit FaultyLine(const Params& params) : params_(params) {}
  ScanLines extract(const Scan& scan, Trace&) const override {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    ScanLines result;
    result.labels.assign(static_cast<std::size_t>(scan.beams()), -1);
    LineFeature line{.segment = {{0, 0}, {1, 0}}, .line = {0.0, kPi / 2}, .covariance = {}};
    line.first_beam = 0;
    line.last_beam = scan.beams() - 1;
    switch (params_.fault) {
      case 1:
        line.first_beam = -1;
        break;
      case 2:
        line.last_beam = scan.beams();
        break;
      case 3:
        line.last_beam = std::numeric_limits<int>::max();
        break;
      case 4:
        line.points = -1;
        break;
      case 5:
        line.rms_m = nan;
        break;
      case 6:
        line.rms_m = -0.1;
        break;
      case 7:
        line.segment.b = Vec2(1e308, 0);
        break;
      case 8:
        line.segment.b = Vec2(0, nan);
        break;
      case 9:
        line.segment.b = line.segment.a;
        break;
      case 10:
        line.covariance = -Eigen::Matrix2d::Identity();
        break;
      case 11:
        line.covariance = Eigen::Matrix2d{{1.0, 0.5}, {0.0, 1.0}};  // not symmetric
        break;
      case 12:
        line.covariance = Eigen::Matrix2d{{1.0, 2.0}, {2.0, 1.0}};  // eigenvalues 3 and -1
        break;
      case 13:
        line.line.alpha = 4.0;
        break;
      case 14:
        line.line.rho = -1.0;
        break;
      case 15:
        line.line.rho += 5.0;  // its segment is 5 m away
        break;
      case 16:
        line.line.rho += 1e-5;  // as a module with numbers of four bytes rounds
        break;
      default:
        break;
    }
    result.lines.push_back(line);
    return result;
  }

 private:
  Params params_;
};
SCANBENCH_REGISTER(LineExtractor, FaultyLine,
                   {.name = "test_faulty_line", .summary = "of the tests", .reference = "none"});

TEST(Pipeline, RefusesALineThatBreaksTheContract) {
  for (const std::int64_t fault : {0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15, 16}) {
    SCOPED_TRACE(fault);
    const study::PipelineSpec pipeline = fixtures::extract_with("p", "test_faulty_line", {{"fault", fault}});
    if (fault == 0 || fault == 16) {
      EXPECT_NO_THROW(run_pipeline(pipeline, recording().observed));
    } else {
      EXPECT_THROW(run_pipeline(pipeline, recording().observed), InvalidResult);
    }
  }
}

/// Returns the guess with a fault of its own.
class FaultyMatch final : public ScanMatcher {
 public:
  struct Params {
    int fault = 0;
    static auto fields() { return std::tuple{field("fault", &Params::fault, at_least(0), "", "which")}; }
  };
  explicit FaultyMatch(const Params& params) : params_(params) {}

  Match match(const Observation&, const Observation&, const Pose2& guess, Trace&) const override {
    Match match{Status::converged, guess, 1e-4 * Eigen::Matrix3d::Identity()};
    if (params_.fault == 1) match.reference_from_current = Pose2(1e300, 0, 0);
    if (params_.fault == 2) match.covariance(1, 2) = 1e-5;
    if (params_.fault == 3) match.covariance(1, 2) = match.covariance(2, 1) = 2e-4;
    if (params_.fault == 4) match.covariance(2, 2) = -1e-4;
    if (params_.fault == 5) std::fesetround(FE_UPWARD);
    return match;
  }

 private:
  Params params_;
};
[[maybe_unused]] const bool match_registered = Registry<ScanMatcher>::add<FaultyMatch>(
    {.name = "test_faulty_match", .summary = "of the tests", .reference = "none"});

TEST(Pipeline, RefusesAMatchThatBreaksTheContract) {
  const auto fault_of = [](std::int64_t fault) -> std::string {
    study::PipelineSpec pipeline = fixtures::extract_with("p", "test_line", {});
    pipeline.slots.push_back({"match", "test_faulty_match", {{"fault", fault}}});
    try {
      run_pipeline(pipeline, recording().observed);
    } catch (const InvalidResult& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault_of(0), "");
  EXPECT_EQ(fault_of(1), "match, frame 1: the pose is beyond 1e6 m");
  EXPECT_EQ(fault_of(2), "match, frame 1: the match has a covariance that is not symmetric");
  EXPECT_EQ(fault_of(3), "match, frame 1: the match has a covariance with a negative eigenvalue");
  EXPECT_EQ(fault_of(4), "match, frame 1: the match has a negative variance");
  EXPECT_EQ(fault_of(5),
            "match, frame 1: the module changed the floating-point arithmetic of its process, and did not "
            "restore it");
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Pipeline, TakesALineWithoutLength) {  // Siadat et al. 1997 count a single returned point as a segment
  const study::PipelineSpec pipeline = fixtures::extract_with("p", "test_faulty_line", {{"fault", std::int64_t{9}}});
  EXPECT_NO_THROW(run_pipeline(pipeline, recording().observed));
}

TEST(Pipeline, WithExtractAloneGivesLinesOfEveryFrameAndNoPoses) {
  const PipelineResult result = run_slots({{"extract", "test_line"}}).result;
  ASSERT_EQ(result.lines.size(), 6u);
  for (const auto& scan : result.lines) EXPECT_EQ(scan.labels.size(), 24u);
  EXPECT_TRUE(result.world_from_sensor.empty());
  EXPECT_TRUE(result.map.lines.empty());
}

TEST(Pipeline, HandsParametersToTheModule) {
  study::PipelineSpec pipeline;
  pipeline.slots = {{"extract", "test_line", {{"skip", std::int64_t{2}}}}};
  const auto skipped = run_pipeline(pipeline, recording().observed).result;
  const auto whole = run_slots({{"extract", "test_line"}}).result;
  EXPECT_EQ(whole.lines[0].lines[0].points - skipped.lines[0].lines[0].points, 2);
}

TEST(Pipeline, TimesEveryStageOfEveryFrameInOrder) {
  const auto times =
      run_slots({{"extract", "test_line"}, {"align", "test_shift"}, {"merge", "test_merge"}}).result.times;
  ASSERT_EQ(times.size(), 2u * 6u + 2u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(times[2 * k].label(), "pre");
    EXPECT_EQ(times[2 * k + 1].label(), "segment");
    EXPECT_EQ(times[2 * k].frame, static_cast<int>(k));
  }
  EXPECT_EQ(times[12].label(), "align");  // a module that names no stage has one
  EXPECT_EQ(times[13].label(), "merge.phase1");
  EXPECT_EQ(times[13].frame, -1);
  for (const auto& time : times) EXPECT_GE(time.seconds, 0.0);
}

TEST(Stopwatch, AddsUpAStageThatComesBackAndCountsOnlyTheTimeBetween) {
  Stopwatch watch;
  std::vector<StageTime> times;
  const double before = thread_cpu_seconds();
  Trace trace = watch.start();
  trace.stage(Stage::pre);
  trace.stage(Stage::fit);
  trace.stage(Stage::pre);
  watch.stop("map", 3, times);
  const double elapsed = thread_cpu_seconds() - before;
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].label(), "map.pre");
  EXPECT_EQ(times[1].label(), "map.fit");
  EXPECT_EQ(times[0].frame, 3);
  EXPECT_GT(times[0].seconds + times[1].seconds, 0.0);
  EXPECT_LE(times[0].seconds + times[1].seconds, elapsed);
}

TEST(Pipeline, MergesLinesPlacedByOdometryOrByAlignedPoses) {
  const auto plain = run_slots({{"extract", "test_line"}, {"merge", "test_merge"}}).result;
  const auto shifted = run_slots({{"extract", "test_line"}, {"align", "test_shift"}, {"merge", "test_merge"}});
  ASSERT_EQ(plain.map.lines.size(), 1u);
  const Vec2 expected = recording().observed.frames[0].odom_from_sensor * plain.lines[0].lines[0].segment.a;
  EXPECT_NEAR((plain.map.lines[0].segment.a - expected).norm(), 0.0, 1e-12);
  const Vec2 moved = shifted.result.map.lines[0].segment.a - plain.map.lines[0].segment.a;
  EXPECT_NEAR((moved - Vec2(10, 20)).norm(), 0.0, 1e-12);
  EXPECT_EQ(shifted.remarks, "align: 1 max_iterations");

  std::size_t valid = 0;
  for (std::size_t k = 0; k < 6; ++k) valid += valid_points(recording().observed.scan(k)).size();
  EXPECT_EQ(plain.map.lines[0].points, static_cast<int>(valid));
  ASSERT_EQ(plain.merge_labels.size(), 6u);
  EXPECT_EQ(plain.merge_labels[3].frame, 3);
  EXPECT_EQ(plain.merge_labels[3].cluster1, 1);
  EXPECT_EQ(plain.merge_labels[3].cluster2, -1);
  EXPECT_EQ(plain.merge_labels[3].map_line, 0);
}

TEST(Pipeline, ChainsMatchesAndFallsBackOnOdometryWhereThereIsNone) {
  const auto run = run_slots({{"extract", "test_line"}, {"match", "test_ahead"}, {"map", "test_mapper"}});
  const auto& frames = recording().observed.frames;
  Pose2 expected = frames[0].odom_from_sensor;
  for (std::size_t k = 0; k < 6; ++k) {
    if (k == 2)
      expected = expected * (frames[1].odom_from_sensor.inverse() * frames[2].odom_from_sensor);
    else if (k > 0)
      expected = expected * Pose2(1, 0, 0);
    const Pose2& found = run.result.world_from_sensor[k];
    EXPECT_NEAR((found.translation() - expected.translation()).norm(), 0.0, 1e-12) << k;
    EXPECT_NEAR(wrap_angle(found.yaw() - expected.yaw()), 0.0, 1e-12) << k;
    EXPECT_NEAR((run.result.map.lines[k].segment.a - expected.translation()).norm(), 0.0, 1e-12) << k;
  }
  EXPECT_EQ(run.remarks, "match: 1 no_match");
  ASSERT_EQ(run.result.matches.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(run.result.matches[k].frame, static_cast<int>(k) + 1);
    EXPECT_EQ(run.result.matches[k].reference, static_cast<int>(k));
    EXPECT_EQ(run.result.matches[k].match.status, k == 1 ? Status::no_match : Status::converged);
  }
}

TEST(Pipeline, TakesASensorWithoutOdometryToGoOnAsItWent) {
  ScanSet scans = recording().observed;
  for (Frame& frame : scans.frames) frame.odom_from_sensor = Pose2(1, 2, 0.5);
  study::PipelineSpec pipeline;
  pipeline.name = "p";
  pipeline.slots = {{"extract", "test_line", {}}, {"match", "test_ahead", {}}};
  const PipelineResult result = run_pipeline(pipeline, scans).result;
  // The second match fails: its guess, the metre ahead of the first one, takes its place.
  for (std::size_t k = 0; k < 6; ++k) {
    const Pose2 expected = Pose2(1, 2, 0.5) * Pose2(static_cast<double>(k), 0, 0);
    EXPECT_NEAR((result.world_from_sensor[k].translation() - expected.translation()).norm(), 0.0, 1e-12) << k;
  }
}

TEST(Pipeline, JournalHasARowForEveryWriteWithItsSlotFrameAndStage) {
  Journal journal;
  const auto plain = run_slots({{"extract", "test_line"}, {"merge", "test_merge"}}).result;
  const auto run = run_slots({{"extract", "test_line"}, {"merge", "test_merge"}}, &journal);
  const io::CsvTable rows(journal.csv(), "trace.csv", {"slot", "frame", "stage", "name", "values"});
  ASSERT_EQ(rows.rows(), 7u);
  EXPECT_EQ(rows.text(4, "slot") + "/" + rows.text(4, "stage") + "/" + rows.text(4, "name"), "extract/segment/line");
  EXPECT_EQ(rows.integer(4, "frame"), 4);
  EXPECT_EQ(rows.text(6, "slot"), "merge");
  EXPECT_EQ(rows.integer(6, "frame"), -1);
  EXPECT_EQ(rows.text(6, "values"), std::to_string(plain.map.lines[0].points));
  EXPECT_EQ(run.result.map.lines[0].segment, plain.map.lines[0].segment);  // a listener changes nothing
}

TEST(Pipeline, BeginsBehindExtractWhereLinesAreGiven) {
  ScanSet lines;
  lines.frames.resize(2);
  lines.frames[0].lines = {{{0, 0}, {1, 0}}, {{0, 1}, {1, 1}}};
  lines.frames[1].lines = {{{0, 0}, {1, 0}}};
  lines.frames[1].odom_from_sensor = Pose2(5, 0, 0);
  study::PipelineSpec pipeline{.name = "p", .slots = {{"merge", "test_merge", {}}}, .published = ""};
  Journal journal;
  const PipelineResult result = run_pipeline(pipeline, lines, &journal).result;
  ASSERT_EQ(result.lines.size(), 2u);
  EXPECT_EQ(result.lines[0].lines[1].segment, lines.frames[0].lines[1]);
  EXPECT_EQ(result.lines[0].lines[1].line, (PolarLine{1.0, kPi / 2}));
  ASSERT_EQ(result.map.lines.size(), 1u);
  EXPECT_EQ(result.map.lines[0].segment, (Segment{{0, 0}, {6, 0}}));  // placed by the second frame's pose
  EXPECT_EQ(result.map.lines[0].members, 3);
  ASSERT_EQ(result.merge_labels.size(), 3u);
  EXPECT_EQ(result.merge_labels[2].frame, 1);
  EXPECT_THAT(journal.csv(), HasSubstr("merge,-1,phase1,points,0"));

  pipeline.slots.insert(pipeline.slots.begin(), {"extract", "test_line", {}});
  EXPECT_THROW(run_pipeline(pipeline, lines), ConfigError);
}

TEST(Pipeline, RefusesChainsThatMakeNoSense) {
  EXPECT_THROW(run_slots({}), ConfigError);
  EXPECT_THROW(run_slots({{"merge", "test_merge"}}), ConfigError);
  EXPECT_THROW(run_slots({{"extract", "test_line"}, {"extract", "test_line"}}), ConfigError);
  EXPECT_THROW(run_slots({{"extract", "test_line"}, {"align", "test_shift"}, {"match", "test_ahead"}}), ConfigError);
  EXPECT_THROW(run_slots({{"extract", "test_line"}, {"merge", "test_merge"}, {"align", "test_shift"}}), ConfigError);
  EXPECT_THROW(run_slots({{"extract", "no such module"}}), ConfigError);
}

TEST(Pipeline, CallsAResultThatBreaksTheContractInvalid) {
  EXPECT_THROW(run_slots({{"extract", "test_wrong_labels"}}), InvalidResult);
}

}  // namespace
}  // namespace scanbench::runs
