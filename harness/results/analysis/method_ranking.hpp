// Rankings of the pipelines of a run: best first, with the probability that each is better than the next, and the time
// that it needs.
//
// Only pipelines that had the same scenarios are ranked together, so that none is best because it was given other or
// fewer cases. The metric is the first of a fixed list (F1, covered walls, pose errors, ...) that most of them have.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/statistics.hpp"
#include "harness/runs/store/run_store.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

struct RankedMethod {
  std::string pipeline;
  MeanInterval quality{};   ///< over seeds, of the average over the scenarios, in the metric's unit
  double seconds = 0.0;     ///< geometric mean, over cells, of the CPU time of a scan; NaN: not known
  std::size_t defined = 0;  ///< cells that have the metric
  std::size_t cells = 0;    ///< cells of the pipeline
  /// The probability that it is better than the next in the list on a new seed of one of the scenarios, a tie counted
  /// as one half, with the 95 % interval of Clopper and Pearson (Biometrika 1934), in which the seeds count as trials.
  /// NaN for the last one and beside pipelines that are not complete.
  MeanInterval beats_next{};
  bool on_front =
      false;  ///< complete, and no other complete pipeline is as good and as fast, and better in one of both

  bool complete() const { return defined == cells; }
};

struct MethodRanking {
  std::vector<std::string> scenarios;
  std::string condition;  ///< of all these scenarios: the noise of the sensor; may be empty
  metrics::MetricDescription quality;
  std::vector<RankedMethod> methods;  ///< best first; then those that are not complete
};

/// What rankings are about, best suited first: F1, covered walls, errors of poses, lines missed. The first that most
/// pipelines have decides.
std::span<const std::string_view> quality_metrics();

/// The value of a metric in a cell: of the subject "all", else "mean", else the mean over its subjects. NaN: none.
double value_in(const std::vector<metrics::MetricRow>& rows, std::string_view metric);

/// Seconds of CPU time of one scan, by cell: the sum over the stages of timing.csv over the recording's number of
/// frames. Cells without these files are absent.
std::map<runs::CellKey, double> load_scan_seconds(const runs::RunStore& store, const std::vector<CellResults>& cells);

/// One ranking per set of scenarios with the same pipelines and the same condition, in the order of the cells. Sets
/// with one pipeline or without a metric of the list are left out. `conditions`: a text by scenario.
std::vector<MethodRanking> rank_methods(const std::vector<CellResults>& cells,
                                        const std::map<runs::CellKey, double>& seconds,
                                        const std::map<std::string, std::string>& conditions = {});

}  // namespace scanbench::results
