// Reads the cells and recordings of a run, whether it keeps them as folders or in archives (archived_run.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

/// A run is not changed while a store of it exists. All functions throw ConfigError for damaged files.
class RunStore {
 public:
  explicit RunStore(std::filesystem::path run);

  const std::filesystem::path& run() const { return run_; }
  /// The planned cells, as the manifest lists them.
  std::vector<CellKey> keys() const;
  /// Nothing for a cell that is missing.
  std::optional<CellRecord> record(const CellKey& key) const;
  bool is_ok(const CellKey& key) const;
  /// The files do not exist if the cell is missing.
  StoredFiles files(const CellKey& key) const;
  /// The rows of metrics.csv; none if there is no such file. Those of a run with archives are from summary.csv, which
  /// has no confidence intervals: to read all archives would take minutes.
  std::vector<metrics::MetricRow> metrics(const CellKey& key) const;
  /// Of all stages, per scan; nothing if it is not known.
  std::optional<double> scan_seconds(const CellKey& key) const;

  using RecordingKey = std::pair<std::string, std::uint64_t>;  ///< scenario and seed
  /// The recordings that exist. Scenarios with shorter names come first.
  std::vector<RecordingKey> recordings() const;
  StoredFiles recording(const std::string& scenario, std::uint64_t seed) const;
  /// The content hash that the recording states; empty if there is no recording.
  std::string recording_hash(const std::string& scenario, std::uint64_t seed) const;

  /// For what changes the files of cells: throws ConfigError, with the command that unpacks them, if cells are in
  /// archives.
  void require_folders() const;

 private:
  struct RecordingFacts {
    std::string content_hash;
    double scans = 0.0;
  };
  const RecordingFacts& facts_of(const RecordingKey& key) const;

  std::filesystem::path run_;
  std::optional<RunArchives> archives_;
  mutable std::map<RecordingKey, RecordingFacts> facts_;  ///< of recordings in folders; those that were requested
  /// Of an archived run, when they were first requested.
  mutable std::optional<std::map<CellKey, std::vector<metrics::MetricRow>>> metrics_;
};

}  // namespace scanbench::runs
