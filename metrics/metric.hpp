// Metrics: pure functions of (observed scans, truth, result) to rows of a table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference_poses.hpp"
#include "core/result.hpp"
#include "core/scan.hpp"
#include "core/truth.hpp"

namespace scanbench::metrics {

/// One value: a row of metrics.csv.
struct MetricRow {
  std::string metric;
  std::string subject;     ///< what it is about: a wall's label, "all", ...
  double value = 0.0;      ///< NaN: not defined on this input (count is then 0)
  std::string unit;        ///< "" for counts and shares
  std::int64_t count = 0;  ///< observations that the value is computed from
  std::optional<double> ci_low;
  std::optional<double> ci_high;
};

/// Which values of a metric are good. `target`: those near one value, MetricDescription::target, on either side.
/// `neither`: no value is better than another one, because the metric describes the input, or because both
/// a low and a high value can come from a bad method.
enum class Direction { lower_is_better, higher_is_better, target, neither };

/// What a metric means, for tables, docs and `compare`.
struct MetricDescription {
  std::string metric;
  std::string label;  ///< short words for heads of tables and axes of figures, without the unit
  std::string unit;   ///< of its values, in files too; pages may scale it
  Direction direction = Direction::neither;
  double tolerance = 0.0;  ///< absolute change, in the metric's unit, that `compare` accepts
  std::string doc;
  bool timing = false;    ///< depends on the machine: excluded from comparisons of bytes
  double target = 0.0;    ///< the best value, in the metric's unit, if direction is `target`
  bool is_share = false;  ///< no value is above 1; no metric has values below 0
};

/// The description of a share: a metric between 0 and 1.
MetricDescription share(MetricDescription metric);

/// The value as a cost, for which lower is better: the value, its negative or its distance from the target. NaN for an
/// undefined value and for a metric of which no value is better.
double cost(const MetricDescription& metric, double value);

/// True if value `a` of the metric is strictly better than `b`. Every defined value is better than an undefined one
/// (NaN), unless the metric's direction is `neither`: then nothing is better.
bool better(const MetricDescription& metric, double a, double b);

struct MetricInput {
  const ScanSet& observed;
  const Truth* truth = nullptr;  ///< nullptr for recorded logs
  const PipelineResult& result;
  const ReferencePoses* reference = nullptr;  ///< of a recorded log, if it has any
};

/// True if there is a truth for every beam of the observed scans and one entry of lines per frame.
bool has_beam_truth(const MetricInput& input);

/// The observations that rows are computed from, one per line, as a file of the cell: <name>.csv.
struct MetricTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< as many values as there are columns
};

/// A family of metrics computed together: borges2000, siadat1997, segments, ... Registered in Registry<MetricFamily>.
class MetricFamily {
 public:
  static constexpr std::string_view kKind = "metrics";
  virtual ~MetricFamily() = default;
  /// Loads what every evaluation in this process, and in those that it forks, would load again. Called before cells
  /// run. Starts no thread. Throws ConfigError if a library is not installed.
  virtual void prepare() const {}
  virtual std::vector<MetricDescription> describe() const = 0;
  /// False if the family is not defined for this input (no truth, no map): its metrics are then absent, not zero.
  virtual bool applies(const MetricInput& input) const = 0;
  /// How many matches of a scan with the last but one it requests, at most. A pipeline with a `match` slot makes them
  /// besides its own, evenly spread over the scans (PipelineResult::skip_matches).
  virtual int skip_matches() const { return 0; }
  virtual std::vector<MetricRow> evaluate(const MetricInput& input) const = 0;
  /// The tables that its parameters request.
  virtual std::vector<MetricTable> tables(const MetricInput&) const { return {}; }
  /// Names of all tables that it can write with any parameters: a later `score` removes those that it does not write.
  virtual std::vector<std::string> table_names() const { return {}; }
};

}  // namespace scanbench::metrics
