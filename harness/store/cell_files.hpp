// A cell on disk: cells/<scenario>/<pipeline>/<seed>/, what one pipeline made of one recording.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/cell_status.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// status.json
struct CellRecord {
  WorkerOutcome outcome;
  std::string address;  ///< cell_address() of what the cell was made of and with
};
std::string status_json(const CellRecord& record);
/// Throws ConfigError, naming the file.
CellRecord load_status(const std::filesystem::path& cell);

/// Writes lines.csv and labels.npy, poses.csv if there are poses, pose_matches.csv with a `match` slot, map.csv if the
/// pipeline has a `map` or `merge` slot, merge_labels.csv with a `merge` slot, and timing.csv into an existing folder.
/// Covariances follow the columns of the contract where an algorithm gives them (cov_offset_m2, cov_offset_angle,
/// cov_angle_rad2).
void write_result(const std::filesystem::path& cell, const PipelineSpec& pipeline, const PipelineResult& result);

/// What write_result wrote; absent files are empty parts. Throws ConfigError, naming file
/// and line, for files that are malformed or do not fit each other.
PipelineResult load_result(const std::filesystem::path& cell);

std::string metrics_csv(const std::vector<metrics::MetricRow>& rows);
/// Throws ConfigError.
std::vector<metrics::MetricRow> load_metrics(const std::filesystem::path& cell);

}  // namespace scanbench::harness
