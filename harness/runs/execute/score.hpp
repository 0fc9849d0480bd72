// Scores cells from their files and the recording's, and writes metrics.csv and summary.csv.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

/// The most matches with the last scan but one that a chosen family requests (MetricFamily::skip_matches).
int skip_matches_requested(const std::vector<study::ModuleChoice>& families);

/// Rows and tables of one cell.
struct Scores {
  std::vector<metrics::MetricRow> rows;
  std::vector<metrics::MetricTable> tables;
  std::string refusals{};  ///< "metrics: raster_truth: ..."; empty if no family refuses
};

/// Rows and tables of all chosen families that apply, in the order of choice. A family that does not apply is absent;
/// so is one that throws ConfigError, whose message is in `refusals`. Throws ConfigError for an unknown family.
Scores evaluate_metrics(const std::vector<study::ModuleChoice>& families, const Recording& recording,
                        const PipelineResult& result);

/// Scores the result in the cell's folder. `recording` comes from load_recording(), which returns the saved bits.
/// Throws ConfigError for an unknown family and for files that cannot be read.
Scores score_cell(const std::vector<study::ModuleChoice>& families, const Recording& recording,
                  const std::filesystem::path& cell);

/// The message of a cell that is ok, with these refusals of metrics in place of those that it has.
std::string message_with(const std::string& message, const std::string& refusals);

/// A table as a file of the cell, <name>.csv.
std::string metric_table_csv(const metrics::MetricTable& table);

/// Scores the finished cells of a run again, with the metrics of the given scenarios, and rewrites metrics.csv, the
/// tables (those of an earlier score that are no longer requested are removed), summary.csv and the manifest's list.
/// Returns the number of scored cells. Throws ConfigError if a cell's scenario is not among them or a file is missing.
/// `progress` is called before each cell is scored. Nothing is written before all are scored, so an exception from it
/// leaves the run unchanged.
std::size_t score_run(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                      const std::function<void(double, const std::string&)>& progress = {});

}  // namespace scanbench::runs
