// The folder of a cell, cells/<scenario>/<pipeline>/<seed>/: the results of one pipeline for one recording.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

inline const RunFile kLinesFile("cells/*/*/*/lines.csv");
inline const RunFile kLabelsFile("cells/*/*/*/labels.npy");
inline const RunFile kMapFile("cells/*/*/*/map.csv");
inline const RunFile kPosesFile("cells/*/*/*/poses.csv");
inline const RunFile kPoseMatchesFile("cells/*/*/*/pose_matches.csv");
inline const RunFile kSkipMatchesFile("cells/*/*/*/skip_matches.csv");
inline const RunFile kMergeFile("cells/*/*/*/merge_labels.csv");
inline const RunFile kTimingFile("cells/*/*/*/timing.csv");
inline const RunFile kStatusFile("cells/*/*/*/status.json");
inline const RunFile kMetricsFile("cells/*/*/*/metrics.csv");

/// status.json
struct CellRecord {
  WorkerOutcome outcome;
  std::string address;  ///< cell_address() of the cell's inputs, settings and program
};
std::string status_json(const CellRecord& record);
/// Throws ConfigError, naming the file.
CellRecord load_status(const StoredFiles& cell);

/// Writes lines.csv and labels.npy, poses.csv if there are poses, pose_matches.csv with a `match` slot,
/// skip_matches.csv if there are such matches, map.csv if the pipeline has a `map` or `merge` slot, merge_labels.csv
/// with a `merge` slot, and timing.csv into an existing folder. Covariances of an algorithm's lines are the last
/// columns: cov_offset_m2, cov_offset_angle, cov_angle_rad2.
void write_result(const std::filesystem::path& cell, const study::PipelineSpec& pipeline, const PipelineResult& result);

/// Reads the files of write_result(); a part without a file is empty. Throws ConfigError with file and line for files
/// that are malformed or contradict each other.
PipelineResult load_result(const StoredFiles& cell);

/// The seconds of all stages in timing.csv, which has a column `seconds`. Throws ConfigError.
double stage_seconds(const io::CsvTable& timing);

std::string metrics_csv(const std::vector<metrics::MetricRow>& rows);
/// Throws ConfigError.
std::vector<metrics::MetricRow> load_metrics(const StoredFiles& cell);

}  // namespace scanbench::runs
