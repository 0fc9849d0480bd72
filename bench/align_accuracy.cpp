// Measures how accurately aligners restore the true poses of scans, paired over seeds, and on how many seeds they
// succeed.
//
//   align_accuracy SCENARIO.yaml [SEEDS [FIRST]] [--set key=value]...
//
// prints one row per pipeline of the scenario: mean errors after the common motion is removed, the number of seeds with
// all scans placed, the number of seeds whose error grew, and the paired ratio and difference to the first pipeline.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "metrics/metric.hpp"

namespace scanbench::accuracy {
namespace {

/// Values of a metric with the subject "all", one per seed.
using Scores = std::map<std::string, std::vector<double>>;

std::string interval_text(const std::vector<double>& values, int digits) {
  const results::MeanInterval i = results::mean_interval(values);
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", i.mean, digits, i.low, digits, i.high, digits);
}

int count_above(const std::vector<double>& values, double limit) {
  int n = 0;
  for (const double v : values) n += v > limit ? 1 : 0;
  return n;
}

Scores scores_of(const study::Scenario& scenario, const study::PipelineSpec& pipeline,
                 const std::vector<Recording>& recordings) {
  Scores scores;
  for (const Recording& recording : recordings) {
    const auto start = std::chrono::steady_clock::now();
    const runs::PipelineRun run = runs::run_pipeline(pipeline, recording.observed);
    scores["seconds"].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    scores["said_good"].push_back(run.remarks.empty() ? 1.0 : 0.0);
    for (const auto& choice : scenario.metrics) {
      const auto family = Registry<metrics::MetricFamily>::make(choice.module, choice.params);
      const metrics::MetricInput input{recording.observed, recording.truth ? &*recording.truth : nullptr, run.result};
      if (!family->applies(input)) continue;
      for (const auto& row : family->evaluate(input))
        if (row.subject == "all") scores[row.metric].push_back(row.value);
    }
  }
  return scores;
}

int run(const std::vector<std::string>& args) {
  if (args.empty()) throw ConfigError("usage: align_accuracy SCENARIO.yaml [SEEDS [FIRST]] [--set key=value]...");
  std::vector<int> numbers;  // number of seeds, and the first seed
  std::vector<std::string> sets;
  for (std::size_t k = 1; k < args.size(); ++k) {
    if (args[k] == "--set" && k + 1 < args.size()) {
      sets.push_back(args[++k]);
    } else {
      numbers.push_back(std::atoi(args[k].c_str()));
    }
  }
  const study::Scenario scenario = study::load_scenario(args[0], sets);
  std::vector<Recording> recordings;
  const int seeds = numbers.empty() ? 20 : numbers[0], first_seed = numbers.size() < 2 ? 1 : numbers[1];
  for (int seed = first_seed; seed < first_seed + seeds; ++seed)
    recordings.push_back(runs::make_recording(scenario, static_cast<std::uint64_t>(seed), 1));

  fmt::print(
      "| pipeline | position [m] | heading [deg] | largest [m] | largest [deg] | all placed | worse | "
      "said good | ratio to {} | difference [m] | seconds |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      scenario.pipelines.front().name);
  Scores first;
  for (const study::PipelineSpec& pipeline : scenario.pipelines) {
    Scores s = scores_of(scenario, pipeline, recordings);
    if (first.empty()) first = s;
    std::vector<double> difference;
    for (std::size_t k = 0; k < s["position_error"].size(); ++k)
      difference.push_back(s["position_error"][k] - first["position_error"][k]);
    const double ratio =
        results::mean_interval(s["position_error"]).mean / results::mean_interval(first["position_error"]).mean;
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {:.3f} | {} | {:.3f} |\n", pipeline.name,
               interval_text(s["position_error"], 4), interval_text(s["heading_error"], 3),
               interval_text(s["position_error_max"], 3), interval_text(s["heading_error_max"], 2),
               count_above(s["all_placed"], 0.5), count_above(s["error_ratio"], 1.0), count_above(s["said_good"], 0.5),
               ratio, interval_text(difference, 4), results::mean_interval(s["seconds"]).mean);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace scanbench::accuracy

int main(int argc, char** argv) {
  try {
    return scanbench::accuracy::run({argv + 1, argv + argc});
  } catch (const scanbench::ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
