// Forecasts against the runs that they foretell.
#include "harness/runs/execute/forecast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/execute/runner.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

study::Scenario room(const std::string& pipelines) {
  return study::parse_scenario(R"(schema: 1
world: {segments: [[a, 0, 0, 10, 0], [b, 10, 0, 10, 8], [c, 10, 8, 0, 8], [d, 0, 8, 0, 0]]}
sensor: {preset: sick_lms200}
trajectory: {kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 60}
seeds: [1, 2, 3]
metrics: [segments]
pipelines: [)" + pipelines + "]\n",
                               "room.yaml");
}

double bytes_of(const fs::path& folder) {
  double bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  return bytes;
}

TEST(Forecast, CellsAndRaysAreExactAndBytesAreNearThoseOfTheRun) {
  const std::vector<study::Scenario> scenarios{
      room("{name: a, extract: {module: iepf}}, {name: b, extract: {module: sef}}")};
  const Forecast forecast = forecast_run(scenarios, {.out = "unused"});
  ASSERT_EQ(forecast.scenarios.size(), 1U);
  const ScenarioForecast& room = forecast.scenarios[0];
  EXPECT_EQ(room.cells, 6U);
  EXPECT_EQ(room.scans, 60U);
  EXPECT_EQ(room.rays, 3 * 60 * 361);
  EXPECT_TRUE(room.in_proportion);
  EXPECT_TRUE(room.faults.empty());
  EXPECT_GT(room.seconds, 0);
  EXPECT_FALSE(fs::exists("unused"));

  const support::TemporaryFolder folder;
  ASSERT_EQ(run(scenarios, {.out = folder.path() / "run"}).exit_code(), 0);
  const double bytes = bytes_of(folder.path() / "run/recordings") + bytes_of(folder.path() / "run/cells");
  EXPECT_NEAR(room.bytes, bytes, 0.1 * bytes);  // the number of lines per scan varies on the way
}

TEST(Forecast, CountsTheSelectionOnly) {
  const std::vector<study::Scenario> scenarios{
      room("{name: a, extract: {module: iepf}}, {name: b, extract: {module: sef}}")};
  EXPECT_EQ(forecast_run(scenarios, {.out = "unused", .only = {"b"}}).scenarios[0].cells, 3U);
}

TEST(Forecast, NamesPipelinesThatFailAndThoseThatGrowFasterThanTheScans) {
  const std::vector<study::Scenario> scenarios{
      room("{name: good, extract: {module: iepf}, merge: {module: greedy_pairs}}, "
           "{name: bad, extract: {module: test_faulty_line, params: {fault: 1}}}")};
  const ScenarioForecast room = forecast_run(scenarios, {.out = "unused"}).scenarios[0];
  EXPECT_FALSE(room.in_proportion);
  EXPECT_THAT(room.faults, ElementsAre(HasSubstr("bad: invalid: ")));
}

TEST(Forecast, OfFewScansIsTheirRun) {
  study::Scenario lines = study::parse_scenario(
      "schema: 1\nworld: {segments: [[a, 0, 0, 4, 0]]}\nlines: {copies: 3}\n"
      "pipelines: [{name: g, merge: {module: greedy_pairs}}]\n",
      "copies.yaml");
  const ScenarioForecast forecast = forecast_run({lines}, {.out = "unused"}).scenarios[0];
  EXPECT_EQ(forecast.scans, 3U);
  EXPECT_EQ(forecast.rays, 0);
  EXPECT_EQ(forecast.sample, 3U);
}

/// Many scenarios that differ in their number of beams, with the same pipelines.
std::vector<study::Scenario> rooms_of_many_sizes(const std::string& pipelines) {
  std::vector<study::Scenario> rooms;
  for (int i = 0; i < 60; ++i) {
    rooms.push_back(room(pipelines));
    rooms.back().name += std::to_string(i);
    rooms.back().seeds = {1};
  }
  return rooms;
}

TEST(Forecast, OfManyScenariosTriesSomeAndForetellsAll) {
  const auto rooms = rooms_of_many_sizes("{name: a, extract: {module: iepf}}, {name: b, extract: {module: polyline}}");
  const auto start = std::chrono::steady_clock::now();
  const Forecast forecast = forecast_run(rooms, {.out = "unused"});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 2 * kForecastSeconds);
  ASSERT_EQ(forecast.scenarios.size(), 60U);
  EXPECT_GE(forecast.tried, 6U);
  for (const ScenarioForecast& one : forecast.scenarios) {
    EXPECT_EQ(one.cells, 2U);
    EXPECT_EQ(one.rays, 60 * 361);
    EXPECT_GT(one.seconds, 0);
    EXPECT_NEAR(one.bytes, forecast.scenarios[0].bytes, 0.1 * one.bytes);  // all rooms are equal
  }
}

TEST(Forecast, OfAPipelineThatDoesNotEndIsCutOff) {
  // Nine scenarios whose second pipeline never ends.
  std::vector<study::Scenario> rooms;
  for (int i = 0; i < 9; ++i) {
    rooms.push_back(room("{name: a, extract: {module: iepf}}, {name: b" + std::to_string(i) +
                         ", extract: {module: test_hang_at_once}}"));
    rooms.back().name += std::to_string(i);
  }
  const auto start = std::chrono::steady_clock::now();
  const Forecast forecast = forecast_run(rooms, {.out = "unused"});
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2 * kForecastSeconds);
  EXPECT_EQ(forecast.cut_off, 9U);
  for (const ScenarioForecast& one : forecast.scenarios) EXPECT_TRUE(one.faults.empty());
}

}  // namespace
}  // namespace scanbench::runs
