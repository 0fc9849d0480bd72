// The chart of basins of convergence from made-up results.
#include "harness/results/figures/basin_chart.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/study/scenario/scenario_file.hpp"

namespace scanbench::results {
namespace {

study::Scenario scenario(const std::string& name, const std::string& preset, double sigma_m, double sigma_deg) {
  study::Scenario made = study::parse_scenario(
      "schema: 1\nworld: {segments: [[a, 0, 0, 4, 0]]}\nsensor: {preset: " + preset +
          "}\ntrajectory: {kind: waypoints, points_m: {A: [1, 1], B: [3, 1]}, scans: 2, odometry: "
          "{pose_position_sigma_m: " +
          std::to_string(sigma_m) + ", pose_heading_sigma_deg: " + std::to_string(sigma_deg) + "}}\n",
      name + ".yaml");
  made.name = name;
  return made;
}

const study::BenchmarkColumn kColumn{.metric = "all_placed", .head = "all placed [%]", .scale = 100, .definition = ""};

TEST(BasinChart, AveragesScenariosOfOneSensorAndOneStartError) {
  const std::vector<study::Scenario> scenarios{scenario("far", "fov360", 0.4, 6), scenario("near", "fov360", 0.1, 1),
                                               scenario("near2", "fov360", 0.1, 1),
                                               scenario("narrow", "fov110", 0.1, 1)};
  std::vector<runs::SummaryRow> rows;
  const auto add = [&](const char* name, std::uint64_t seed, double value) {
    rows.push_back({name, "a", seed, "all_placed", "all", value, "", 1});
  };
  for (const std::uint64_t seed : {1, 2}) {
    add("far", seed, 0.0);
    add("near", seed, 1.0);
    add("near2", seed, seed == 1 ? 1.0 : 0.0);
    add("narrow", seed, 1.0);
  }
  const render::FacetChart chart = basin_chart(scenarios, rows, {"a"}, kColumn);
  ASSERT_EQ(chart.x.ticks.size(), 2U);
  EXPECT_EQ(chart.x.ticks[0].second, "10/1") << "the smaller error first";
  EXPECT_EQ(chart.x.ticks[1].second, "40/6");
  EXPECT_EQ(chart.curve_names, (std::vector<std::string>{"fov360", "fov110"}));
  ASSERT_EQ(chart.facets.size(), 1U);
  ASSERT_EQ(chart.facets[0].curves.size(), 2U);
  const auto& wide = chart.facets[0].curves[0];
  ASSERT_EQ(wide.points.size(), 2U);
  EXPECT_NEAR(wide.points[0].y(), 75.0, 1e-9) << "1 and a half, over the seeds";
  EXPECT_NEAR(wide.points[1].y(), 0.0, 1e-9);
  EXPECT_LE(wide.intervals[0][2], 100.0) << "a share";
  const auto& narrow = chart.facets[0].curves[1];
  ASSERT_EQ(narrow.points.size(), 1U) << "no far scenario has this sensor";
  EXPECT_NEAR(narrow.points[0].y(), 100.0, 1e-9);
}

TEST(BasinChart, LeavesOutWhatHasNoResult) {
  const std::vector<study::Scenario> scenarios{scenario("near", "fov360", 0.1, 1)};
  const render::FacetChart chart = basin_chart(scenarios, {}, {"a"}, kColumn);
  ASSERT_EQ(chart.facets.size(), 1U);
  EXPECT_TRUE(chart.facets[0].curves[0].points.empty());
}

}  // namespace
}  // namespace scanbench::results
