// A benchmark: all cells of a suite as one ranking of its pipelines. What is requested (the suite's key `benchmark`,
// benchmark.json in the run folder), and the table.
//
// A condition is one scenario of the suite: a world seen by one sensor at one noise level. Every condition counts the
// same, whatever the number of lines in it: a value is averaged over the conditions first, for each seed, and the seeds
// give the interval then. Shares, lengths and angles are averaged by the arithmetic mean, ratios and times by the
// geometric mean. What is undefined in a cell (the error of an extractor that found nothing) is left out of the
// average; F1 is always defined where there are walls.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "harness/analysis/statistics.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// Standard deviation of the readings of a simulated scenario, the part that does not grow with range.
double noise_m(const Scenario& scenario);

/// A column of the ranking.
struct BenchmarkColumn {
  std::string metric;  ///< of summary.csv; or "t_ratio": time over that of the baseline in the same condition and seed
  std::string head;    ///< with its unit
  double scale = 1.0;
  int decimals = 2;
  bool geometric = false;
  metrics::Direction direction = metrics::Direction::lower_is_better;
  std::string definition;  ///< a sentence for the reader of the page
  double target = 0.0;     ///< the best value if direction is `target`

  metrics::MetricDescription description() const;  ///< for comparisons of values
};
const std::vector<BenchmarkColumn>& benchmark_columns();

struct RankedPipeline {
  std::string name;
  std::map<std::string, MeanInterval> values;  ///< by the metric of a column; in the unit of summary.csv
  int missing = 0;                             ///< cells without an F1: not ok, or not there
  double next_difference = 0.0;  ///< mean F1 minus that of the next in rank, paired by seed; NaN for the last
  double next_p = 1.0;           ///< of that difference, paired t test, corrected after Holm; NaN: no test
  int conditions_won = 0;        ///< in which its F1, averaged over the seeds, is the best
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

/// Best F1 first; ties by name. Pipelines that miss cells come last: what they did not finish was not measured.
std::vector<RankedPipeline> rank_pipelines(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows,
                                           const BenchmarkSpec& spec);

}  // namespace scanbench::harness
