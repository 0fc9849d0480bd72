// A benchmark: all cells of a suite as one ranking of its pipelines. What is asked for (the suite's key `benchmark`,
// benchmark.json in the run folder), and the table.
//
// A condition is one scenario of the suite: a world seen by one sensor at one noise level. Every condition counts the
// same, whatever the number of lines in it: a value is averaged over the conditions first, for each seed, and the seeds
// give the interval then. Shares, lengths and angles are averaged by the arithmetic mean, ratios and times by the
// geometric mean. What is undefined in a cell (the error of an extractor that found nothing) is left out of the
// average; F1 is always defined where there are walls.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "harness/benchmark_subject.hpp"
#include "harness/results_table.hpp"
#include "harness/scenario.hpp"
#include "harness/statistics.hpp"
#include "harness/yaml_gate.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

struct BenchmarkSpec {
  std::string about;           ///< the suite's
  std::string baseline;        ///< pipeline that times are given as ratios to
  std::string example;         ///< scenario of which one scan is shown
  std::string of = "extract";  ///< slot whose modules are ranked

  const BenchmarkSubject& subject() const { return benchmark_subject(of); }
};

/// Reads the key `benchmark` of a suite of these scenarios: {of: extract, baseline: iepf, example: rooms-1cm}. `of` is
/// extract unless given, the example the first scenario; `about` stays empty. Throws PlacedError for unknown names, and
/// if the scenarios are not simulated, do not share the same pipelines, or lack a metric that the subject requires.
BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios);

std::string benchmark_json(const BenchmarkSpec& spec);
/// Of a run folder; nothing if the run is no benchmark. Throws ConfigError if the file is damaged.
std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run);

/// Standard deviation of the readings of a simulated scenario, the part that does not grow with range.
double noise_m(const Scenario& scenario);

struct RankedPipeline {
  std::string name;
  std::map<std::string, Interval> values;  ///< by the metric of a column; in the unit of summary.csv
  int missing = 0;                         ///< cells without a value of the rank's metric: not ok, or not there
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

/// "F1 − next", "MSE / bound over next": the column that compares a pipeline with the next in rank.
std::string next_head(const BenchmarkColumn& rank);

Table ranking_table(const std::vector<RankedPipeline>& ranking, const BenchmarkSpec& spec);

}  // namespace scanbench::harness
