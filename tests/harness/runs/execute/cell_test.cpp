// Files and address of a cell.
#include "harness/runs/store/cell_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fstream>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/runs/execute/cell_address.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/sections.hpp"
#include "tests/support/places.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

study::PipelineSpec full_pipeline(bool covariance) {
  study::PipelineSpec pipeline = fixtures::extract_with("p", "test_line", {{"covariance", covariance}});
  pipeline.slots.push_back({"align", "test_shift", {}});
  pipeline.slots.push_back({"merge", "test_merge", {}});
  return pipeline;
}

TEST(CellFiles, GiveBackAResult) {
  const support::TemporaryFolder folder;
  const Recording recording = fixtures::random_recording(2, 5, 16, true);
  for (const bool covariance : {false, true}) {
    const study::PipelineSpec pipeline = full_pipeline(covariance);
    PipelineResult saved = run_pipeline(pipeline, recording.observed).result;
    saved.lines[1] = {{}, std::vector<int>(16, -1)};  // a frame without lines
    saved.merge_labels.erase(saved.merge_labels.begin() + 1);
    write_result(folder.path(), pipeline, saved);
    const PipelineResult loaded = load_result(folder.path());
    ASSERT_EQ(loaded.lines.size(), saved.lines.size());
    for (std::size_t k = 0; k < saved.lines.size(); ++k) {
      EXPECT_EQ(loaded.lines[k].labels, saved.lines[k].labels);
      ASSERT_EQ(loaded.lines[k].lines.size(), saved.lines[k].lines.size());
      for (std::size_t i = 0; i < saved.lines[k].lines.size(); ++i) {
        const LineFeature& a = loaded.lines[k].lines[i];
        const LineFeature& b = saved.lines[k].lines[i];
        EXPECT_EQ(a.segment, b.segment);
        EXPECT_EQ(a.line, b.line);
        EXPECT_EQ(a.first_beam, b.first_beam);
        EXPECT_EQ(a.last_beam, b.last_beam);
        EXPECT_EQ(a.points, b.points);
        EXPECT_EQ(a.rms_m, b.rms_m);
        ASSERT_EQ(a.covariance.has_value(), covariance);
        if (covariance) {
          EXPECT_EQ(*a.covariance, *b.covariance);
        }
      }
    }
    ASSERT_EQ(loaded.world_from_sensor.size(), saved.world_from_sensor.size());
    for (std::size_t k = 0; k < saved.world_from_sensor.size(); ++k) {
      const Pose2& a = loaded.world_from_sensor[k];
      const Pose2& b = saved.world_from_sensor[k];
      EXPECT_EQ(a.translation(), b.translation());
      EXPECT_NEAR(wrap_angle(a.yaw() - b.yaw()), 0.0, 1e-15);
    }
    ASSERT_EQ(loaded.map.lines.size(), 1u);
    EXPECT_EQ(loaded.map.lines[0].segment, saved.map.lines[0].segment);
    EXPECT_EQ(loaded.map.lines[0].members, saved.map.lines[0].members);
    EXPECT_EQ(loaded.map.lines[0].points, saved.map.lines[0].points);
    ASSERT_EQ(loaded.merge_labels.size(), saved.merge_labels.size());
    EXPECT_EQ(loaded.merge_labels[2].frame, saved.merge_labels[2].frame);
    EXPECT_EQ(loaded.merge_labels[2].cluster1, saved.merge_labels[2].cluster1);
    EXPECT_EQ(loaded.merge_labels[2].map_line, saved.merge_labels[2].map_line);
    ASSERT_EQ(loaded.times.size(), saved.times.size());
    EXPECT_EQ(loaded.times[1].stage, saved.times[1].stage);
    EXPECT_EQ(loaded.times[1].seconds, saved.times[1].seconds);
  }
}

TEST(CellFiles, GiveBackMatchesOfPoses) {
  const support::TemporaryFolder folder;
  const Recording recording = fixtures::random_recording(2, 5, 16, true);
  study::PipelineSpec pipeline = fixtures::extract_with("p", "test_line");
  pipeline.slots.push_back({"match", "test_ahead", {}});
  PipelineResult saved = run_pipeline(pipeline, recording.observed).result;
  ASSERT_EQ(saved.matches.size(), 4u);
  Eigen::Matrix3d covariance;
  covariance << 1.0 / 3, 2, 3, 2, 5, 6, 3, 6, 7;
  saved.matches[2].match = {Status::degenerate, {0.1, -2.0 / 3, 0.25}, covariance};
  write_result(folder.path(), pipeline, saved);
  const PipelineResult loaded = load_result(folder.path());
  ASSERT_EQ(loaded.matches.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(loaded.matches[k].frame, saved.matches[k].frame);
    EXPECT_EQ(loaded.matches[k].reference, saved.matches[k].reference);
    EXPECT_EQ(loaded.matches[k].match.status, saved.matches[k].match.status);
    EXPECT_EQ(loaded.matches[k].match.covariance, saved.matches[k].match.covariance);
    const Pose2 &a = loaded.matches[k].match.reference_from_current, &b = saved.matches[k].match.reference_from_current;
    EXPECT_EQ(a.translation(), b.translation());
    EXPECT_NEAR(wrap_angle(a.yaw() - b.yaw()), 0.0, 1e-15);
  }
  const std::string text = io::read_file(folder.path() / "pose_matches.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "frame,reference,x_m,y_m,yaw_rad,cov_xx_m2,cov_xy_m2,cov_xyaw_m,cov_yy_m2,cov_yyaw_m,cov_yaw_rad2,status");
}

TEST(CellFiles, WithLabelsOfLinesThatAreNotThereAreRefused) {
  const support::TemporaryFolder folder;
  const Recording recording = fixtures::random_recording(2, 5, 16, true);
  write_result(folder.path(), full_pipeline(false), run_pipeline(full_pipeline(false), recording.observed).result);
  const std::string header = "frame,line,cluster1,cluster2,map_line\n";
  const auto refusal = [&](const std::string& row) {
    std::ofstream(folder.path() / "merge_labels.csv") << header << row << '\n';
    try {
      load_result(folder.path());
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("0,0,1,1,0"), "");
  EXPECT_EQ(refusal("0,0,1,1,-1"), "");  // dropped
  EXPECT_THAT(refusal("0,99,1,1,0"), HasSubstr("merge_labels.csv:2: frame 0 has no line 99"));
  EXPECT_THAT(refusal("5,0,1,1,0"), HasSubstr("frame 5 has no line 0"));
  EXPECT_THAT(refusal("0,0,1,1,1000"), HasSubstr("the map has no line 1000; it has "));
}

TEST(CellFiles, HaveTheNamesAndColumnsOfTheContract) {
  const support::TemporaryFolder folder;
  const Recording recording = fixtures::random_recording(2, 5, 16, true);
  write_result(folder.path(), full_pipeline(false), run_pipeline(full_pipeline(false), recording.observed).result);
  const auto header = [&](const char* name) {
    const std::string text = io::read_file(folder.path() / name);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_THAT(fixtures::listing(folder.path()),
              ElementsAre("labels.npy", "lines.csv", "map.csv", "merge_labels.csv", "poses.csv", "timing.csv"));
  EXPECT_EQ(header("lines.csv"), "frame,line,x1_m,y1_m,x2_m,y2_m,rho_m,alpha_rad,first_beam,last_beam,points,rms_m");
  EXPECT_EQ(header("map.csv"), "line,x1_m,y1_m,x2_m,y2_m,members,points");
  EXPECT_EQ(header("poses.csv"), "frame,x_m,y_m,yaw_rad");
  EXPECT_EQ(header("merge_labels.csv"), "frame,line,cluster1,cluster2,map_line");
  EXPECT_EQ(header("timing.csv"), "stage,frame,seconds");

  const support::TemporaryFolder alone;
  const study::PipelineSpec extract = fixtures::extract_with("p", "test_line");
  write_result(alone.path(), extract, run_pipeline(extract, recording.observed).result);
  EXPECT_THAT(fixtures::listing(alone.path()), ElementsAre("labels.npy", "lines.csv", "timing.csv"));
  EXPECT_FALSE(load_result(alone.path()).has_map);
}

TEST(CellFiles, DistinguishAnEmptyMapFromNone) {
  const support::TemporaryFolder folder;
  PipelineResult nothing_merged;
  nothing_merged.has_map = true;
  write_result(folder.path(), full_pipeline(false), nothing_merged);
  const PipelineResult loaded = load_result(folder.path());
  EXPECT_TRUE(loaded.has_map);
  EXPECT_TRUE(loaded.map.lines.empty());
}

TEST(CellFiles, KeepStatusAndMetrics) {
  const support::TemporaryFolder folder;
  CellRecord record;
  record.outcome.status = CellStatus::timeout;
  record.outcome.message = "quote \" and bad bytes \xff\n";
  record.outcome.wall_seconds = 1.5;
  record.outcome.cpu_seconds = 0.1;
  record.outcome.peak_memory_bytes = 1e9;
  record.address = "abc";
  io::write_file_atomically(folder.path() / "status.json", status_json(record));
  const CellRecord loaded = load_status(folder.path());
  EXPECT_EQ(loaded.outcome.status, CellStatus::timeout);
  EXPECT_THAT(loaded.outcome.message, HasSubstr("quote \" and bad bytes"));
  EXPECT_EQ(loaded.outcome.wall_seconds, 1.5);
  EXPECT_EQ(loaded.outcome.peak_memory_bytes, 1e9);
  EXPECT_EQ(loaded.address, "abc");
  for (const char* bad : {"", "[]", "{}", R"({"status": "fine"})", R"({"status": 5})"}) {
    io::write_file_atomically(folder.path() / "status.json", bad);
    EXPECT_THROW(load_status(folder.path()), ConfigError) << bad;
  }

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string text = metrics_csv({{"eta", "w,1", 0.1, "m", 7, -0.5, {}}, {"missed", "all", nan, "", 0, {}, 2.0}});
  EXPECT_EQ(text,
            "metric,subject,value,unit,count,ci_low,ci_high\n"
            "eta,\"w,1\",0.1,m,7,-0.5,\n"
            "missed,all,,,0,,2\n");
  io::write_file_atomically(folder.path() / "metrics.csv", text);
  const auto rows = load_metrics(folder.path());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].ci_low, -0.5);
  EXPECT_FALSE(rows[0].ci_high.has_value());
  EXPECT_TRUE(std::isnan(rows[1].value));
  EXPECT_EQ(metrics_csv(rows), text);
}

TEST(CellFiles, ThatDoNotFitEachOtherAreRefused) {
  const support::TemporaryFolder folder;
  const Recording recording = fixtures::random_recording(2, 5, 16, true);
  const study::PipelineSpec extract = fixtures::extract_with("p", "test_line");
  write_result(folder.path(), extract, run_pipeline(extract, recording.observed).result);
  const std::string lines = io::read_file(folder.path() / "lines.csv");
  io::write_file_atomically(folder.path() / "lines.csv", lines.substr(0, lines.find('\n') + 1));
  EXPECT_THROW(load_result(folder.path()), ConfigError);  // labels of lines that are not there
  io::write_file_atomically(folder.path() / "lines.csv", lines + "5,0,0,0,1,1,0,0,0,1,2,0\n");
  EXPECT_THROW(load_result(folder.path()), ConfigError);  // frame 5 of 0 .. 4
}

TEST(CellAddress, ChangesWithEverythingThatTheResultDependsOn) {
  const study::Scenario base =
      fixtures::scenario_with("s", {fixtures::extract_with("p", "test_line", {{"skip", 1.0}})});
  const auto address = [](const study::Scenario& s, std::uint64_t seed = 1) {
    return cell_address(input_address(s), work_address(s.metrics, s.pipelines[0]), seed, {});
  };
  EXPECT_EQ(address(base), address(base));
  std::vector<study::Scenario> others(7, base);
  others[0].pipelines[0].slots[0].params["skip"] = 2.0;
  others[1].pipelines[0].slots[0].params["skip"] = std::string("1");
  others[2].metrics.pop_back();
  std::get<study::SimulatedInput>(others[3].input).world.walls = {{"w", {Vec2(0, 0), Vec2(1, 0)}}};
  std::get<study::SimulatedInput>(others[4].input).odometry_params["rotation_deg_per_deg"] = 0.1;
  std::get<study::SimulatedInput>(others[5].input).trajectory.params["scans"] = std::int64_t{3};
  std::get<study::SimulatedInput>(others[6].input).tilt_params["pitch_sigma_deg"] = 0.1;
  for (const auto& other : others) EXPECT_NE(address(other), address(base));
  EXPECT_NE(address(base, 2), address(base, 1));
  study::Scenario renamed = base;
  renamed.about = "another text about the same";
  EXPECT_EQ(address(renamed), address(base));
}

TEST(CellAddress, ChangesWithTheCopiesOfLinesAndTheirTruth) {
  study::Scenario base = fixtures::scenario_with("s", {});
  study::LinesInput input;
  input.world.emplace().walls = {{"a", {{0, 0}, {1, 0}}}};
  input.params = {{"copies", std::int64_t{3}}};
  std::vector<study::LinesInput> others(3, input);
  others[0].world.reset();
  others[1].params["copies"] = std::int64_t{4};
  others[2].world->walls[0].segment.b.x() = 2;
  base.input = input;
  for (const auto& other : others) {
    study::Scenario changed = base;
    changed.input = other;
    EXPECT_NE(input_address(changed), input_address(base));
  }
}

TEST(CellAddress, FollowsTheBytesOfALineFileAndNotItsPath) {
  const support::TemporaryFolder folder;
  const auto address = [&](const std::string& name, const std::string& bytes) {
    study::Scenario scenario = fixtures::scenario_with("s", {});
    study::LinesInput input;
    input.file = folder.path() / name;
    scenario.input = input;
    io::write_file_atomically(input.file, bytes);
    return input_address(scenario);
  };
  EXPECT_EQ(address("a.csv", "1"), address("b.csv", "1"));
  EXPECT_NE(address("a.csv", "1"), address("a.csv", "2"));
}

TEST(CellAddress, OfAScenarioWithAWorldFileIsThatOfItsEffectiveScenario) {
  const support::TemporaryFolder folder;
  const fs::path world = places::source_dir() / "scenarios/worlds/borges15.yaml";
  io::write_file_atomically(folder.path() / "s.yaml",
                            "schema: 1\nworld: {file: " + world.string() +
                                "}\nsensor: {preset: ladar_2d30}\n"
                                "trajectory: {kind: waypoints, points_m: {A: [6.45, 3.15], B: [4.6, 1.5]}, scans: 3}\n"
                                "pipelines:\n  - {name: a, extract: {module: test_line}}\nmetrics: [test_metrics]\n");
  const study::Scenario scenario = study::load_scenario(folder.path() / "s.yaml");
  io::write_file_atomically(folder.path() / "effective.yaml", study::effective_yaml(scenario));
  const study::Scenario effective = study::load_scenario(folder.path() / "effective.yaml");
  EXPECT_EQ(input_address(scenario), input_address(effective));
  EXPECT_EQ(work_address(scenario.metrics, scenario.pipelines[0]),
            work_address(effective.metrics, effective.pipelines[0]));
}

TEST(CellAddress, FollowsTheBytesOfATableOfWallsAndNotItsPath) {
  const support::TemporaryFolder folder;
  const auto address = [&](const std::string& segments) {
    io::write_file_atomically(folder.path() / "s.yaml",
                              "schema: 1\nworld: {name: w, segments: " + segments +
                                  "}\nsensor: {preset: ladar_2d30}\n"
                                  "trajectory: {kind: waypoints, points_m: {A: [1, 1], B: [2, 1]}, scans: 2}\n");
    return input_address(study::load_scenario(folder.path() / "s.yaml"));
  };
  const std::string header = "label,x1_m,y1_m,x2_m,y2_m\n";
  io::write_file_atomically(folder.path() / "a.csv", header + "a,0,0,4,0\n");
  io::write_file_atomically(folder.path() / "same.csv", header + "a,0,0,4,0\n");
  io::write_file_atomically(folder.path() / "other.csv", header + "a,0,0,4,1\n");
  EXPECT_EQ(address("{file: a.csv}"), address("{file: same.csv}"));
  EXPECT_EQ(address("{file: a.csv}"), address("[[a, 0, 0, 4, 0]]"));
  EXPECT_NE(address("{file: a.csv}"), address("{file: other.csv}"));
}

TEST(CellAddress, FollowsTheBytesOfALog) {
  const support::TemporaryFolder folder;
  study::Scenario scenario = fixtures::scenario_with("s", {});
  study::RecordedInput input;
  input.log = folder.path() / "log";
  for (const auto& spec : study::recorded_sensor_specs()) input.sensor_params[spec.name] = 0.0;
  scenario.input = input;
  EXPECT_THROW(input_address(scenario), ConfigError);
  io::write_file_atomically(folder.path() / "log", "1");
  const std::string one = input_address(scenario);
  io::write_file_atomically(folder.path() / "log", "2");
  EXPECT_NE(input_address(scenario), one);
}

}  // namespace
}  // namespace scanbench::runs
