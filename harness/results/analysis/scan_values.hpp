// The values of a cell's metrics scan by scan, computed again from the files of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/results/analysis/block_bootstrap.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::results {

/// A metric that is a mean over scans, over pairs of neighbouring scans, or over the relations of a log.
struct ScanValues {
  ScanMean mean = ScanMean::mean;
  const char* of = "scans";    ///< or "pairs of scans", or "relations", all in the order of their first scans
  std::vector<double> values;  ///< one per scan, in the metric's unit; NaN: the scan has none
  std::vector<double> weights;
};

/// Reads the cells of one run; keeps the last recording and the last cell in memory.
class ScanValueReader {
 public:
  explicit ScanValueReader(std::filesystem::path run);
  ~ScanValueReader();
  ScanValueReader(const ScanValueReader&) = delete;
  ScanValueReader& operator=(const ScanValueReader&) = delete;

  /// True if the cell is of a recording without a truth whose files are there.
  bool is_log(const runs::CellKey& key);

  /// Evaluates the metric's family on every scan alone. That the weighted mean of these values, or the root of the mean
  /// of their squares, equals the value of the whole shows that the metric is such a mean; nullopt for other metrics
  /// (medians, the largest value, a map's). The weight of a scan is the row's count. Throws ConfigError for damaged
  /// files.
  std::optional<ScanValues> of(const runs::CellKey& key, const std::string& metric);

  /// The metric on every scan alone, one value per scan of the recording, in the metric's unit; that of a pair of
  /// neighbours is at its later scan. NaN: the scan has none. nullopt if the metric says nothing about single scans:
  /// that of a map, of a trajectory, of walls. Throws ConfigError for damaged files.
  std::optional<std::vector<double>> by_scan(const runs::CellKey& key, const std::string& metric);

 private:
  struct Cell;
  runs::RunStore store_;
  std::map<std::pair<std::string, std::uint64_t>, bool> logs_;  ///< recordings: is it one of a log
  std::unique_ptr<Cell> cell_;
};

}  // namespace scanbench::results
