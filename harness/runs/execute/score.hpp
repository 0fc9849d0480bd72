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

/// Rows of all chosen families that apply, in the order of choice; a family that does not apply is absent. Throws
/// ConfigError for an unknown family.
std::vector<metrics::MetricRow> evaluate_metrics(const std::vector<study::ModuleChoice>& families,
                                                 const Recording& recording, const PipelineResult& result);

/// Rows and tables of one cell.
struct Scores {
  std::vector<metrics::MetricRow> rows;
  std::vector<metrics::MetricTable> tables;
};

/// Scores the result in the cell's folder: the same rows, and the families' tables. `recording` comes from
/// load_recording(), which returns the saved bits.
Scores score_cell(const std::vector<study::ModuleChoice>& families, const Recording& recording,
                  const std::filesystem::path& cell);

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
