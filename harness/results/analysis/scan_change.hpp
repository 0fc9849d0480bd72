// The scan that shows best what a change of a metric means.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/scan_values.hpp"

namespace scanbench::results {

struct ScanChange {
  std::size_t frame = 0;
  std::size_t scans = 0;  ///< among which it was chosen
  metrics::MetricDescription metric;
  bool substitute = false;  ///< the metric in question says nothing about single scans, or all scans have equal values
  double before = 0.0;      ///< of this scan, in the metric's unit
  double after = 0.0;       ///< NaN: the scan has no value any more
};

/// The scan of a cell on which the metric became worse by most; if it became worse on none, the one on which it changed
/// most. Where the metric has no values of single scans, or none changed, the headline metrics are tried in the order
/// of headline_metrics(). nullopt if none of them changed on any scan, or the runs have different numbers of scans.
/// Throws ConfigError for damaged files.
std::optional<ScanChange> most_changed_scan(ScanValueReader& before, ScanValueReader& after, const runs::CellKey& key,
                                            const metrics::MetricDescription& metric);

}  // namespace scanbench::results
