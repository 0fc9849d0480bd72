// Plans of runs with too many cells or seeds given twice.
#include "harness/runs/execute/run_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::runs {
namespace {

using ::testing::HasSubstr;

study::Scenario scenario_with(std::size_t pipelines, std::size_t seeds) {
  study::Scenario scenario;
  scenario.name = "room";
  for (std::size_t i = 0; i < pipelines; ++i) {
    scenario.pipelines.emplace_back();
    scenario.pipelines.back().name = "p" + std::to_string(i);
  }
  scenario.seeds.resize(seeds);
  std::iota(scenario.seeds.begin(), scenario.seeds.end(), std::uint64_t{1});
  return scenario;
}

TEST(RunPlan, RefusesMoreCellsThanAManifestCanList) {
  EXPECT_THAT(support::config_refusal([] { plan_run({scenario_with(2, 500'000)}, {}); }),
              HasSubstr("the run would have 1000000 cells; allowed: at most 200000"));
}

TEST(RunPlan, RefusesASeedThatIsGivenTwice) {
  study::Scenario scenario = scenario_with(1, 3);
  scenario.seeds = {7, 8, 7};
  EXPECT_THAT(support::config_refusal([&] { plan_run({scenario}, {}); }), HasSubstr("the seed 7 is given twice"));
}

TEST(RunPlan, NamesTheFileOfAScenarioWithoutPipelines) {
  const study::Scenario scenario = study::parse_scenario(R"(# a comment
schema: 1
world: {segments: [[a, 0, 0, 4, 0]]}
sensor: {preset: ladar_2d30}
trajectory: {kind: waypoints, points_m: {A: [1, 1], B: [3, 1]}, scans: 4}
)",
                                                         "rooms/empty.yaml");
  EXPECT_THAT(support::config_refusal([&] { plan_run({scenario}, {}); }),
              ::testing::StartsWith("rooms/empty.yaml:2:1: scenario 'empty' has no pipelines; allowed: at least one"));
}

}  // namespace
}  // namespace scanbench::runs
