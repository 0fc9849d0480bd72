// A cell on disk: cells/<scenario>/<pipeline>/<seed>/, what one pipeline made of one recording.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "harness/scenario.hpp"
#include "harness/traces.hpp"
#include "harness/worker.hpp"
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

/// SHA-256 of the input of a scenario: world bytes, sensor, trajectory, odometry, tilt; or log bytes, format and how it
/// is read. Throws ConfigError if the log cannot be read.
std::string input_address(const Scenario& scenario);

/// SHA-256 over everything that a cell's bytes depend on: the input, the seed, the pipeline's resolved parameters, the
/// chosen metrics, the rows of the trace that are kept, and the running program.
std::string cell_address(const std::string& input, const std::vector<ModuleChoice>& metrics,
                         const PipelineSpec& pipeline, std::uint64_t seed, const TraceChoice& trace);

}  // namespace scanbench::harness
