// The scenarios of a run folder: large worlds are stored as tables of walls.
#include "harness/runs/store/run_scenarios.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/wall_table.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A scenario with this number of walls, one metre apart.
study::Scenario with_walls(const std::string& name, int count, double length_m = 1.0) {
  std::string text =
      "schema: 1\nname: " + name +
      "\nsensor: {preset: ladar_2d30}\ntrajectory: {kind: waypoints, points_m: {A: [1, 1], B: [2, 1]}, scans: "
      "2}\nworld: {segments: [[w0, 0, 0, 0, 1]]}\n";
  study::Scenario scenario = study::parse_scenario(text, "/nowhere/s.yaml");
  auto& walls = std::get<study::SimulatedInput>(scenario.input).world.walls;
  for (int i = 1; i < count; ++i) {
    const double x = i;
    walls.push_back({"w" + std::to_string(i), {{x, 0}, {x, length_m}}});
  }
  return scenario;
}

EffectiveText effective_text() {
  return [](const study::Scenario& scenario, const study::StoredInputs& stored) {
    return study::effective_yaml(scenario, stored);
  };
}

void write_run(const fs::path& run, const std::vector<study::Scenario>& scenarios) {
  io::make_folders(run);
  Manifest manifest{.state = "complete", .start = "", .end = "", .argv = {}, .scenarios = {}, .cells = {}};
  for (const auto& scenario : scenarios) manifest.scenarios.push_back(scenario.name);
  write_run_scenarios(run, scenarios, effective_text());
  write_manifest(run, manifest);
}

const std::vector<Wall>& walls_of(const study::Scenario& scenario) {
  return std::get<study::SimulatedInput>(scenario.input).world.walls;
}

TEST(RunScenarios, OfLargeWorldsNameATableInTheRun) {
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run", moved = folder.path() / "moved";
  const std::vector<study::Scenario> scenarios{with_walls("large", 1001), with_walls("small", 1000)};
  write_run(run, scenarios);
  fs::rename(run, moved);
  EXPECT_THAT(io::read_file(moved / "effective/large.yaml"),
              HasSubstr("segments:\n    file: \"../inputs/large/walls.csv\"\n"));
  EXPECT_EQ(io::read_file(moved / "effective/small.yaml"), study::effective_yaml(scenarios[1]));
  EXPECT_EQ(io::read_file(moved / "inputs/large/walls.csv"), study::wall_table(walls_of(scenarios[0])));
  EXPECT_FALSE(fs::exists(moved / "inputs/small"));
  const std::vector<study::Scenario> loaded = load_run_scenarios(moved);
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    EXPECT_EQ(study::effective_yaml(loaded[i]), study::effective_yaml(scenarios[i]));
  EXPECT_THAT(scenario_files(moved, {"large", "small"}), testing::Contains(fs::path("inputs/large/walls.csv")));
  EXPECT_TRUE(listed_hashes(moved).contains("inputs/large/walls.csv"));
}

TEST(RunScenarios, OfALargeWorldMakeTheSameFilesAgain) {
  const support::TemporaryFolder folder;
  write_run(folder.path() / "a", {with_walls("large", 1200)});
  const auto again = study::load_scenario(folder.path() / "a/effective.yaml");
  write_run(folder.path() / "b", {again});
  for (const char* file : {"effective.yaml", "inputs/large/walls.csv"})
    EXPECT_EQ(io::read_file(folder.path() / "a" / file), io::read_file(folder.path() / "b" / file)) << file;
}

TEST(RunScenarios, WithOtherWallsHaveOtherSettings) {
  const support::TemporaryFolder folder;
  for (const auto& [name, length_m] : {std::pair("a", 1.0), std::pair("b", 1.5), std::pair("c", 1.0)})
    write_run(folder.path() / name, {with_walls("large", 1200, length_m)});
  const auto a = load_run_settings(folder.path() / "a"), b = load_run_settings(folder.path() / "b");
  EXPECT_NE(a.at("large"), b.at("large"));
  EXPECT_EQ(a, load_run_settings(folder.path() / "c"));
  EXPECT_THAT(a.at("large").at("world.segments.file"), testing::StartsWith("SHA-256 "));
}

}  // namespace
}  // namespace scanbench::runs
