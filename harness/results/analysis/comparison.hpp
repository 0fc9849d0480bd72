// Two runs compared: for every pipeline and metric of a scenario, the change over the seeds with its interval, what
// may be said of it, and what has failed or is missing.
//
// Both runs have the same seeds, and a seed fixes the noise. Differences are therefore taken pair by pair, and an
// algorithm that nobody touched differs by exactly zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/results/analysis/cell_pair.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/scan_pairs.hpp"
#include "harness/results/analysis/statistics.hpp"

namespace scanbench::results {

enum class Finding {
  same,       ///< equal to the bit on every seed
  within,     ///< the mean changed by no more than the tolerance
  uncertain,  ///< it changed by more, but the seeds do not agree: the interval contains 0, or too many gates are tested
  better,
  worse,
  changed,       ///< of a metric without a better direction
  not_compared,  ///< times of two processors, or of fewer than nine seeds
};
std::string_view to_string(Finding finding);

/// The values of one seed, in the metric's unit. NaN: not defined.
struct SeedPair {
  std::uint64_t seed = 0;
  double before = 0.0;
  double after = 0.0;
};

/// A metric of a pipeline in a scenario. The value of a seed is that of the subject "all", else the mean over the
/// subjects that are defined in both runs.
struct MetricChange {
  std::string scenario;
  std::string pipeline;
  metrics::MetricDescription metric;  ///< with the gate's tolerance
  bool gate = false;                  ///< may fail the comparison
  std::vector<SeedPair> pairs;        ///< seeds that are ok in both runs
  std::size_t lost = 0;               ///< pairs whose value is no longer defined or finite
  std::optional<PairedScans> scans;   ///< of a recorded log whose scans are paired
  std::string by_value{};             ///< why the scans of a recorded log are not paired; else empty
  SubjectCounts subjects{};           ///< largest differences between the sets of subjects in both means
  double before = 0.0;                ///< means over the pairs that are defined in both
  double after = 0.0;
  /// after - before: mean and 95 % interval; low = high = mean for fewer than three pairs, which have no interval. The
  /// count is that of seeds or scans.
  MeanInterval difference{};
  MeanInterval worsening{};  ///< of the costs (metrics::cost), above 0: worse; empty without a better direction
  double effect = 0.0;       ///< the mean difference over the standard deviation of the differences; NaN: none
  double p = 1.0;            ///< of no change; NaN where nothing was tested
  double q = 1.0;            ///< the same, corrected for the number of gates (Benjamini and Hochberg)
  Finding finding = Finding::same;

  /// True where the change is compared with the tolerance alone: fewer than three pairs tell nothing about the spread.
  bool by_tolerance() const { return !scans && difference.count < 3; }
  /// The pair that became worse by most; nullptr if no pair is defined.
  const SeedPair* worst() const;
};

/// A cell that has another status than before.
struct StatusChange {
  runs::CellKey cell;
  std::string before;  ///< "ok", "crashed", ..., "missing"
  std::string after;
  std::string message;  ///< of the run that is judged
};

struct Comparison {
  std::string before;  ///< names of the two runs
  std::string after;
  std::vector<std::string> differing;  ///< what differs between the runs: "commit: a -> b", settings, scans
  std::vector<MetricChange> changes;   ///< scenario by scenario, pipeline by pipeline
  std::vector<StatusChange> broken;    ///< ok before, not now
  std::vector<StatusChange> mended;    ///< ok now, not before
  std::vector<StatusChange> failing;   ///< not ok now, and before not ok or not there
  std::vector<runs::CellKey> missing;  ///< requested, or there before, and not there now
  bool unfinished = false;             ///< a cell that the run that is judged was to have is missing
  std::vector<std::string> absent;     ///< "abcdef/iepf: f1": gates that were there before and have no rows now
  std::vector<std::string> dropped;    ///< other metrics that were there before and have no rows now
  std::vector<runs::CellKey> added;    ///< there now only: not compared
  std::size_t cells = 0;               ///< compared: ok in both runs
  std::size_t gates = 0;               ///< gates with at least one pair

  std::size_t count(Finding finding, bool gates_only = true) const;
  bool failed() const;  ///< a gate is worse, or a cell is not ok
  bool incomplete() const { return !missing.empty() || !absent.empty(); }
  /// Of whole runs without a cell that is ok in both: nothing can be said.
  bool compared_nothing() const { return cells == 0 && !failed() && !unfinished; }
  /// 0 good, 1 failed, 2 nothing was compared, 4 incomplete, 5 failed and incomplete.
  int exit_code() const;
};

/// `before` is what the run `after` is judged against.
///
/// A gate is worse if the 95 % interval of its mean difference excludes zero, the mean difference is above the
/// tolerance, and, among all gates of this comparison that a test can judge, at most 5 % of such findings are false
/// (q <= 0.05). The mean difference of fewer than three pairs is compared with the tolerance alone. A recorded log has
/// one pair; if the folders of both runs are known and the metric is a mean over its scans, these are paired instead
/// (block_bootstrap.hpp). A gate whose value is lost on some seed is worse too.
/// Throws ConfigError for damaged files of a log.
Comparison compare(const RunResults& before, const RunResults& after, const Gates& gates);

}  // namespace scanbench::results
