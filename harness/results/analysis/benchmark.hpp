// A benchmark ranks the pipelines of a suite over all of its cells (harness/study/scenario/benchmark_spec.hpp reads its
// specification).
//
// A condition is one scenario of the suite: a world seen by one sensor at one noise level. Every condition has the same
// weight, independent of its number of lines: for each seed a value is averaged over the conditions, and the seeds then
// give the interval. Shares, lengths and angles are averaged by the arithmetic mean, ratios and times by the geometric
// mean; a value that should be 3 on average (NEES) by the arithmetic one, for 0.3 and 30 are not 3 together. Values
// that are undefined in a cell (the error of an extractor that found nothing) are left out of the average; F1 is always
// defined if there are walls.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "harness/results/analysis/statistics.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/benchmark_subject.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// Standard deviation of the readings of a simulated scenario, the part that does not grow with range.
double noise_m(const study::Scenario& scenario);

/// The least and the greatest average of a condition over the seeds; NaN without values.
struct ConditionRange {
  double least;
  double most;
};

struct RankedPipeline {
  std::string name;
  std::map<std::string, ConditionRange> ranges;        ///< by the metric of a column that shows its range
  std::map<std::string, MeanInterval> values;          ///< by the metric of a column; in the unit of summary.csv
  std::map<std::string, std::vector<double>> by_seed;  ///< what these are the means of
  int missing = 0;         ///< cells without a value of the rank's metric: not ok, or not there
  MeanInterval next{};     ///< seed_interval() of the rank's metric minus that of the next in rank, paired by seed, of
                           ///< the logarithms where the mean is geometric; count 0 for the last
  int conditions_won = 0;  ///< in which it is the best, averaged over the seeds
};

/// The value of a metric (subject "all") in every cell: by pipeline, seed and scenario.
using CellValues = std::map<std::tuple<std::string, std::uint64_t, std::string>, double>;
CellValues values_of(const std::vector<runs::SummaryRow>& rows, const std::string& metric);

/// For each seed, the average over the scenarios of these names; NaN for a seed without values.
std::vector<double> per_seed(const CellValues& values, const std::string& pipeline,
                             const std::vector<std::uint64_t>& seeds, const std::vector<std::string>& scenarios,
                             bool geometric = false);

/// Seeds of the rows, increasing: a run may have others than its scenarios name.
std::vector<std::uint64_t> seeds_of(const std::vector<runs::SummaryRow>& rows);

/// Best value of the subject's first column first; ties by name. Pipelines with missing cells come last, because they
/// are not measured on all of them.
std::vector<RankedPipeline> rank_pipelines(const std::vector<study::Scenario>& scenarios,
                                           const std::vector<runs::SummaryRow>& rows, const study::BenchmarkSpec& spec);

/// The rank's metric at one level of a factor: averaged over its conditions for every seed, then over the seeds.
struct LevelResult {
  std::string factor;
  std::string level;
  std::vector<MeanInterval> values;  ///< one per name; all NaN for a pipeline with missing cells at this level
  std::vector<int> leaders{};        ///< indices, from shared_best(): the best first; empty if no pipeline has a value
  std::vector<std::vector<double>> by_seed{};  ///< one per name: what `values` are the means of
};

/// One result per level of the specification that has scenarios in the run; `names` are pipelines.
std::vector<LevelResult> results_by_level(const std::vector<study::Scenario>& scenarios,
                                          const std::vector<runs::SummaryRow>& rows, const study::BenchmarkSpec& spec,
                                          const std::vector<std::string>& names);

/// Head of the column that compares a pipeline with the next in rank: "F1 − next", "MSE / bound over next".
std::string next_head(const study::BenchmarkColumn& rank);

}  // namespace scanbench::results
