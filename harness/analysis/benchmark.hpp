// A benchmark: all cells of a suite as one ranking of its pipelines. What is requested (the suite's key `benchmark`,
// benchmark.json in the run folder), and the table.
//
// A condition is one scenario of the suite: a world seen by one sensor at one noise level. Every condition counts the
// same, whatever the number of lines in it: a value is averaged over the conditions first, for each seed, and the seeds
// give the interval then. Shares, lengths and angles are averaged by the arithmetic mean, ratios and times by the
// geometric mean. What is undefined in a cell (the error of an extractor that found nothing) is left out of the
// average; F1 is always defined where there are walls, and the errors of poses where a matcher gives one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "harness/analysis/statistics.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/benchmark_subject.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// Standard deviation of the readings of a simulated scenario, the part that does not grow with range.
double noise_m(const Scenario& scenario);

struct RankedPipeline {
  std::string name;
  std::map<std::string, MeanInterval> values;  ///< by the metric of a column; in the unit of summary.csv
  int missing = 0;                             ///< cells without a value of the rank's metric: not ok, or not there
  double next_difference = 0.0;  ///< mean of the rank's metric minus that of the next in rank, paired by seed, of the
                                 ///< logarithms where the mean is geometric; NaN for the last
  double next_p = 1.0;           ///< of that difference, paired t test, corrected after Holm; NaN: no test
  int conditions_won = 0;        ///< in which it is the best, averaged over the seeds
};

/// The value of a metric (subject "all") in every cell: by pipeline, seed and scenario.
using CellValues = std::map<std::tuple<std::string, std::uint64_t, std::string>, double>;
CellValues values_of(const std::vector<SummaryRow>& rows, const std::string& metric);

/// Seed by seed the average over the scenarios of these names; NaN for a seed without values.
std::vector<double> per_seed(const CellValues& values, const std::string& pipeline,
                             const std::vector<std::uint64_t>& seeds, const std::vector<std::string>& scenarios,
                             bool geometric = false);

/// Seeds of the rows, increasing: a run may have others than its scenarios name.
std::vector<std::uint64_t> seeds_of(const std::vector<SummaryRow>& rows);

/// Best first by the first column of the subject; ties by name. Pipelines that miss cells come last: what they did not
/// finish was not measured.
std::vector<RankedPipeline> rank_pipelines(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows,
                                           const BenchmarkSpec& spec);

/// Head of the column that compares a pipeline with the next in rank: "F1 − next", "MSE / bound over next".
std::string next_head(const BenchmarkColumn& rank);

}  // namespace scanbench::harness
