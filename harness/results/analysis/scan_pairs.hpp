// Pairs the scans of recorded logs in two runs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/block_bootstrap.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/scan_values.hpp"

namespace scanbench::results {

/// The scans that give the change on a recorded log its interval. A log has one value per run and no seeds to pair.
struct PairedScans {
  std::size_t count = 0;     ///< of all scans, also of those without a value
  const char* of = "scans";  ///< or "pairs of scans", "relations"
  std::size_t block = 0;     ///< length of the bootstrap's blocks
  std::size_t lost = 0;      ///< scans that have a value only in the earlier run
  std::size_t gained = 0;    ///< only in the later one
};

/// The scans of one value of a log, or why they are not paired.
struct ScanPairs {
  ScanMean mean = ScanMean::mean;
  std::vector<ScanPair> pairs{};  ///< of the same scan in both runs, in the order of the log
  PairedScans counts{};
  std::string obstacle{};  ///< why there are no pairs; empty if there are
};

class ScanPairer {
 public:
  /// Reads the folders of the runs, where they are known.
  ScanPairer(const RunResults& before, const RunResults& after);

  /// nullopt if the cell is not of a log in either run. Throws ConfigError for damaged files.
  std::optional<ScanPairs> pairs_of(const runs::CellKey& key, const std::string& metric, bool same_recording);

 private:
  struct Side {
    const RunResults& run;
    std::optional<ScanValueReader> reader;
    explicit Side(const RunResults& results);
    bool is_log(const runs::CellKey& key) { return reader && reader->is_log(key); }
  };
  Side before_;
  Side after_;
};

}  // namespace scanbench::results
