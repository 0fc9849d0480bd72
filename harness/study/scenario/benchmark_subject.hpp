// What a benchmark ranks: line extractors, scan matchers or aligners. Which metric decides, which are shown, and the
// words for it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "metrics/metric.hpp"

namespace scanbench::study {

/// A column of the ranking.
struct BenchmarkColumn {
  std::string metric;  ///< of summary.csv; or "t_ratio": time over that of the baseline in the same condition and seed
  std::string head;    ///< with its unit
  double scale = 1.0;
  int decimals = 2;
  bool geometric = false;  ///< averaged by the geometric mean over the conditions
  metrics::Direction direction = metrics::Direction::lower_is_better;
  std::string definition;  ///< a sentence for the reader of the page
  double target = 0.0;     ///< the best value if direction is `target`
  /// Also shows the least and the greatest condition: the average of some far below the target and others far above is
  /// near it. Such a column is averaged by the arithmetic mean if the target is what a mean should be.
  bool shows_range = false;

  bool is_share() const;                           ///< shown in percent
  std::string name() const;                        ///< the head without its unit
  metrics::MetricDescription description() const;  ///< for comparisons of values
};

/// A metric family that every scenario of the benchmark must have, and a parameter of it that must be true ("": none).
struct RequiredMetric {
  std::string family;
  std::string parameter;
};

/// Errors and costs are compared among pipelines that answer about as often: one that answers only easy cases errs
/// little.
struct FairComparison {
  std::string metric;   ///< of a column: how much a pipeline answers
  double margin = 0.0;  ///< largest distance from the best value that still takes part
  std::string caption;  ///< the rule in words, below the ranking
  /// Times are compared among pipelines whose first column is at most this many times the best; 0: among all of the
  /// above. Who answers wrongly may be fast.
  double times = 0.0;
};

/// How far a pipeline is from the best possible.
struct DistanceFromBound {
  std::string metric;  ///< of a column: a mean square error over its bound
  std::string of;      ///< what errs: "poses"
};

struct BenchmarkSubject {
  std::string slot;                      ///< kind of the modules that are ranked
  std::string noun;                      ///< "extractor"
  std::string time_metric;               ///< numerator of the column t_ratio, and its denominator for the baseline
  std::string counted;                   ///< what count_metric counts: "true lines"; empty: nothing but scans
  std::string count_metric;              ///< its rows of the baseline have the counts
  std::vector<BenchmarkColumn> columns;  ///< the first one decides the rank
  std::vector<RequiredMetric> required;
  FairComparison fair;
  DistanceFromBound bound;
  std::string method;               ///< how the values of the ranking are made
  std::vector<std::string> limits;  ///< what the page does not show
  bool shows_example = false;       ///< one scan as every pipeline sees it, and errors of lines over range
  std::string over_start;  ///< metric drawn over the error of the given poses, in place of curves over noise and bound

  const BenchmarkColumn& rank_column() const { return columns.front(); }
};

/// The subject whose modules have this kind; throws ConfigError for a kind that no benchmark ranks.
const BenchmarkSubject& benchmark_subject(std::string_view slot);

/// The kinds that benchmarks rank: "extract", "match", "align".
std::vector<std::string> benchmark_slots();

}  // namespace scanbench::study
