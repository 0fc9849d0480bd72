// Two runs compared pair by pair: same scenario, pipeline, seed, metric and subject.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/store/run_folder.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

enum class Verdict {
  same,        ///< equal to the bit, or both undefined
  within,      ///< changed by no more than the tolerance
  better,      ///< changed by more, in the metric's direction
  worse,       ///< changed by more, against it; or no longer defined; or the cell no longer ok
  changed,     ///< changed by more, of a metric without direction
  timing,      ///< depends on the machine: shown, never judged
  only_in_a,   ///< the row, or the whole cell, is missing in B
  only_in_b,   ///< the row, or the whole cell, is missing in A
  not_judged,  ///< the cell is ok in neither run
};
std::string_view to_string(Verdict verdict);

struct ComparisonRow {
  CellKey cell;
  std::string metric;  ///< "status" for a cell that is not ok or missing in a run
  std::string subject;
  double a = 0.0;
  double b = 0.0;
  double difference = 0.0;  ///< b - a; 0 if both are undefined
  std::string unit;
  metrics::Direction direction = metrics::Direction::neither;
  double tolerance = 0.0;
  Verdict verdict = Verdict::same;
  std::string note;  ///< the statuses in A and B, if the metric is "status"
};

struct Comparison {
  std::vector<ComparisonRow> rows;  ///< in the order of A's summary, then those that only B has
  std::vector<std::string> notes;   ///< recordings that differ: differences may come from them
  std::map<Verdict, int> counts;
  bool incomplete = false;  ///< a cell or row of one run is missing in the other, or a requested cell in both
  /// 0 nothing is worse or missing, 1 something is worse, 4 incomplete, 5 both.
  int exit_code() const;
};

/// `tolerances`, by metric, replace those of the metric families. Throws ConfigError if A or B is not a run.
Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b,
                        const std::map<std::string, double>& tolerances = {});

/// scenario,pipeline,seed,metric,subject,a,b,difference,unit,direction,tolerance,verdict
std::string comparison_csv(const Comparison& comparison);

}  // namespace scanbench::harness
