// The scans and lines that a page holds are those of the run.
#include "harness/results/player/played_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "harness/results/player/player_page.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "tests/support/archives.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

/// 16-bit numbers of a base64 text, lowest byte first.
std::vector<int> decoded(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(alphabet.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  std::vector<int> numbers;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const auto low = static_cast<unsigned char>(bytes[i]), high = static_cast<unsigned char>(bytes[i + 1]);
    numbers.push_back(static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8)));
  }
  return numbers;
}

class PlayedRun : public ::testing::Test {
 protected:
  void SetUp() override {
    scenarios_ = {fixtures::scenario_with("s", {fixtures::extract_with("a", "test_line")}, {4, 2})};
    fixtures::run_here(scenarios_, {.out = out_});
    scenarios_[0].input = study::RecordedInput{};  // these random scans have no world
  }
  support::TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "r";
  std::vector<study::Scenario> scenarios_;
};

TEST_F(PlayedRun, HasTheRangesAndLinesWithinHalfAStep) {
  const auto json = played_run(out_, scenarios_);
  ASSERT_EQ(json.size(), 2U);  // both seeds fit
  const auto& played = json[0];
  const Recording recording = runs::load_recording(runs::recording_path(out_, "s", 4));
  const double step = played["step_m"];
  const std::vector<int> ranges = decoded(played["ranges"]);
  ASSERT_EQ(ranges.size(), 5U * 16U);
  for (std::size_t f = 0; f < 5; ++f)
    for (int beam = 0; beam < 16; ++beam) {
      const Scan scan = recording.observed.scan(f);
      const double range = scan.valid(beam) ? scan.ranges[as_index(beam)] : 0.0;
      EXPECT_NEAR(ranges[16 * f + as_index(beam)] * step, range, 0.5001 * step);
    }
  const PipelineResult result = runs::load_result(runs::cell_path(out_, {"s", "a", 4}));
  const auto& pipeline = played["pipelines"][0];
  const std::vector<int> lines = decoded(pipeline["lines"]);
  std::size_t k = 0;
  for (std::size_t f = 0; f < 5; ++f) {
    ASSERT_EQ(pipeline["counts"][f], result.lines[f].lines.size());
    for (const LineFeature& line : result.lines[f].lines)
      for (const double value : {line.segment.a.x(), line.segment.a.y(), line.segment.b.x(), line.segment.b.y()})
        EXPECT_NEAR(lines.at(k++) * step, value, 0.5001 * step);
  }
  EXPECT_EQ(k, lines.size());
}

TEST_F(PlayedRun, HasTheTrueWallsAndPosesToAMillimetre) {
  const auto json = played_run(out_, scenarios_, {.scans = 3});
  const Recording recording = runs::load_recording(runs::recording_path(out_, "s", 4));
  const auto& walls = json[0]["walls"];
  ASSERT_EQ(walls.size(), 4U * recording.truth->walls.size());
  ASSERT_FALSE(walls.empty());
  for (std::size_t k = 0; k < recording.truth->walls.size(); ++k) {
    const Segment& wall = recording.truth->walls[k].segment;
    for (const auto& [i, value] :
         {std::pair(0U, wall.a.x()), std::pair(1U, wall.a.y()), std::pair(2U, wall.b.x()), std::pair(3U, wall.b.y())})
      EXPECT_NEAR(walls[4 * k + i].get<double>(), value, 0.000501);
  }
  ASSERT_EQ(json[0]["frames"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose2& pose = recording.truth->world_from_sensor[json[0]["frames"][i].get<std::size_t>()];
    EXPECT_NEAR(json[0]["poses"][3 * i].get<double>(), pose.translation().x(), 0.000501);
    EXPECT_NEAR(json[0]["poses"][3 * i + 1].get<double>(), pose.translation().y(), 0.000501);
    EXPECT_NEAR(json[0]["poses"][3 * i + 2].get<double>(), pose.yaw(), 0.00000501);
  }
}

TEST_F(PlayedRun, HoldsTheOtherSeedsOnlyIfAllTheirScansFit) {
  EXPECT_EQ(played_run(out_, scenarios_).size(), 2U);
  const auto cut = played_run(out_, scenarios_, {.scans = 4});
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut[0]["seed"], "4");
  const auto with_second = played_run(out_, scenarios_, {.scans = 1}, PlayedRecordings{{{"s", 2}, {1, 3, 70}}});
  ASSERT_EQ(with_second.size(), 2U);
  EXPECT_THAT(with_second[1]["frames"], testing::IsSupersetOf({1, 3}));
  EXPECT_LE(with_second[1]["frames"].size(), 3U);
  EXPECT_EQ(played_run(out_, scenarios_, {}, PlayedRecordings{}).size(), 1U);
}

TEST_F(PlayedRun, HasTheSameBytesWhenItsCellsAreInAnArchive) {
  const auto expected = played_run(out_, scenarios_);
  fixtures::archive_cells(out_);
  ASSERT_FALSE(std::filesystem::exists(out_ / "cells"));
  EXPECT_EQ(played_run(out_, scenarios_), expected);
}

TEST_F(PlayedRun, CutByItsLimitsSaysSo) {
  const auto json = played_run(out_, scenarios_, {.scans = 2});
  EXPECT_EQ(json[0]["frames"].size(), 2U);
  EXPECT_EQ(json[0]["of"], 5);
  EXPECT_EQ(decoded(json[0]["ranges"]).size(), 2U * 16U);
  const auto one = played_run(out_, scenarios_, {.bytes = 1});  // too few for anything: one scan remains
  EXPECT_EQ(one[0]["frames"].size(), 1U);
}

TEST_F(PlayedRun, WithoutAFinishedCellIsRefused) {
  std::filesystem::remove_all(out_ / "cells");
  EXPECT_THROW(player_page(out_, scenarios_), ConfigError);
}

TEST_F(PlayedRun, PageCannotBeEndedByANameInItsData) {
  scenarios_[0].input = study::RecordedInput{};
  std::get<study::RecordedInput>(scenarios_[0].input).log = "</script><b>.log";
  EXPECT_EQ(player_page(out_, scenarios_).find("</script><b>"), std::string::npos);
}

}  // namespace
}  // namespace scanbench::results
