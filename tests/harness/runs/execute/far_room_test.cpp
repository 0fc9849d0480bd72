// A room in the coordinates of a map: every metric is that of the same room near zero.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/study/scenario/scenario_file.hpp"

namespace scanbench::runs {
namespace {

/// A room of 6 m by 4 m with a box, its corner at a point.
study::Scenario room_at(double x, double y) {
  std::string walls;
  const auto add = [&](const std::string& name, double x1, double y1, double x2, double y2) {
    walls += fmt::format("{}[{}, {}, {}, {}, {}]", walls.empty() ? "" : ", ", name, x + x1, y + y1, x + x2, y + y2);
  };
  add("south", 0, 0, 6, 0);
  add("east", 6, 0, 6, 4);
  add("north", 6, 4, 0, 4);
  add("west", 0, 4, 0, 0);
  add("box_a", 2, 2.5, 2.5, 3.25);
  add("box_b", 2.5, 3.25, 3.25, 2.75);
  return study::parse_scenario(fmt::format(R"(schema: 1
world: {{segments: [{}]}}
sensor: {{preset: ladar_2d30}}
trajectory:
  kind: waypoints
  points_m: {{A: [{}, {}], B: [{}, {}]}}
  scans: 5
  odometry: {{pose_position_sigma_m: 0.03, pose_heading_sigma_deg: 1}}
pipelines:
  - {{name: lines, extract: {{module: iepf, params: {{threshold_m: 0.1}}}}}}
  - {{name: matched, extract: {{module: optimal}}, match: {{module: plicp}}, merge: {{module: greedy_pairs}}}}
  - {{name: aligned, extract: {{module: optimal}}, align: {{module: point_to_line}}}}
  - {{name: mapped, extract: {{module: iepf, params: {{threshold_m: 0.1}}}}, map: {{module: navigation_map}}}}
metrics: [borges2000, siadat1997, segments, efficiency, pose_efficiency, closure, trajectory, alignment, map_truth,
          map_points, raster_truth]
)",
                                           walls, x + 1, y + 1, x + 5, y + 1.5),
                               "room.yaml");
}

std::map<std::string, double> values_of(const study::Scenario& scenario) {
  const Recording recording = make_recording(scenario, 1, 1);
  std::map<std::string, double> values;
  for (const auto& pipeline : scenario.pipelines) {
    const PipelineRun run = run_pipeline(pipeline, recording.observed, nullptr, {}, 3);
    const Scores scores = evaluate_metrics(scenario.metrics, recording, run.result);
    EXPECT_EQ(scores.refusals, "") << pipeline.name;
    for (const auto& row : scores.rows)
      values[fmt::format("{} {} {}", pipeline.name, row.metric, row.subject)] = row.value;
  }
  return values;
}

TEST(FarRoom, HasTheMetricsOfARoomNearZero) {
  const auto near = values_of(room_at(0, 0));
  EXPECT_GT(near.at("lines raster_f1 all"), 0.5);
  EXPECT_GT(near.size(), 100u);
  for (const auto& [x, y] : {std::pair(500000.0, 5000000.0), std::pair(1e7, -1e7)}) {
    const auto far = values_of(room_at(x, y));
    ASSERT_EQ(far.size(), near.size());
    for (const auto& [name, value] : near) {
      if (name.find(" t_") != std::string::npos) continue;  // times
      if (std::isnan(value)) {
        EXPECT_TRUE(std::isnan(far.at(name))) << name;
        continue;
      }
      // Coordinates there are multiples of 1e-9 m, and a line's end can be rounded to the next pixel.
      const double rounding = name.find(" raster_") == std::string::npos ? 1e-5 : 3e-3;
      EXPECT_NEAR(far.at(name), value, rounding * std::max(1.0, std::fabs(value))) << name << " at " << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace scanbench::runs
