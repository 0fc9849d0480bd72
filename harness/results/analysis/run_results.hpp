// What a run has found, in memory: the outcome and the metrics of every cell, and what made them. It comes from a run
// folder, from the store of earlier runs or from a baseline, and is what comparisons read.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// The subject of a baseline's mean over subjects (walls). The row's count is the number of those that have a value.
inline constexpr const char* kMeanOfSubjects = "mean over walls";

struct CellResults {
  runs::CellKey key;
  bool requested = true;  ///< false: left out by --only, so that it may be missing
  std::string status;     ///< a name of CellStatus, or "missing"
  std::string message;
  std::string recording;                 ///< hash of the scans; empty: not known
  std::vector<metrics::MetricRow> rows;  ///< in the order of metrics.csv; empty unless the status is "ok"

  bool ok() const { return status == "ok"; }
};

struct RunResults {
  std::string name;  ///< of the folder, the night or the baseline, for messages
  /// Where its cells and recordings are; empty: only its values are known.
  std::filesystem::path folder{};
  runs::Provenance provenance;
  /// By scenario, every effective setting by its path: "pipelines.iepf.extract.params.threshold_m" -> "0.1".
  std::map<std::string, std::map<std::string, std::string>> settings;
  std::vector<CellResults> cells;      ///< in the order of summary.csv
  std::vector<std::string> overrides;  ///< "key=value" of --set
};

/// Throws ConfigError unless the folder is that of a run. Reads nothing outside it. The rows of a run with archives
/// have no intervals (run_store.hpp).
RunResults load_run_results(const std::filesystem::path& run);

}  // namespace scanbench::results
