// raster_truth and map_truth order the pipelines of a real scenario alike.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/places.hpp"

namespace scanbench::runs {
namespace {

double harmonic_mean(double a, double b) {
  return 2 * a * b / (a + b);
}

TEST(RasterTruth, OrdersPipelinesAsMapTruthDoesOnTheHallway) {
  study::Scenario scenario = study::load_scenario(places::source_dir() / "scenarios/lakaemper2009_hallway.yaml");
  // Coarser and coarser lines beside those of the scenario, so that the maps differ.
  for (const double threshold : {0.1, 0.3, 0.6, 1.2})
    scenario.pipelines.push_back(
        {.name = "iepf" + std::to_string(threshold),
         .slots = {{"extract", "iepf", {{"threshold_m", threshold}}}, {"merge", "greedy_pairs", {}}},
         .published = ""});
  const Recording recording = make_recording(scenario, 1, 1);
  std::vector<std::pair<double, double>> scores;  // by map_truth, by raster_truth
  for (const study::PipelineSpec& pipeline : scenario.pipelines) {
    std::map<std::string, double> values;
    for (const auto& row :
         evaluate_metrics(scenario.metrics, recording, run_pipeline(pipeline, recording.observed).result).rows)
      values[row.metric] = row.value;
    scores.emplace_back(harmonic_mean(values.at("covered_5cm"), values.at("true_share_5cm")), values.at("raster_f1"));
  }
  int ordered = 0;
  for (const auto& [truth_a, raster_a] : scores)
    for (const auto& [truth_b, raster_b] : scores) {
      if (!(truth_a > truth_b + 0.02)) continue;
      EXPECT_GT(raster_a, raster_b) << truth_a << " before " << truth_b;
      ++ordered;
    }
  EXPECT_GE(ordered, 12) << "the maps differ too little";
}

}  // namespace
}  // namespace scanbench::runs
