// Scores from files: a recording's folder and a cell's folder in, metrics.csv and summary.csv out.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/run_folder.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// Rows of all chosen families that apply, in the order of choice; a family that does not apply is absent. Throws
/// ConfigError for an unknown family.
std::vector<metrics::MetricRow> evaluate_metrics(const std::vector<ModuleChoice>& families, const Recording& recording,
                                                 const PipelineResult& result);

/// Rows and tables of one cell.
struct Scores {
  std::vector<metrics::MetricRow> rows;
  std::vector<metrics::MetricTable> tables;
};

/// The same and the families' tables, the result read from the cell's folder. `recording` is what load_recording()
/// gives: bit for bit what was saved.
Scores score_cell(const std::vector<ModuleChoice>& families, const Recording& recording,
                  const std::filesystem::path& cell);

/// A table as a file of the cell, <name>.csv.
std::string metric_table_csv(const metrics::MetricTable& table);

/// Scores the finished cells of a run again, with the metrics of the given scenarios, and rewrites metrics.csv,
/// the tables (those of an earlier score that are no longer requested are removed), summary.csv and the manifest's
/// list. Returns how many cells were scored. Throws ConfigError if a cell's scenario is not among them or a file is
/// missing. `progress` is told of each cell before it is scored; nothing is written before all are, so that whatever it
/// throws leaves the run as it was.
std::size_t score_run(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                      const std::function<void(double, const std::string&)>& progress = {});

}  // namespace scanbench::harness
