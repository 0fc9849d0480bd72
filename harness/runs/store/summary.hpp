// summary.csv: the rows of all cells in one tidy table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

inline const RunFile kSummaryFile("summary.csv");

/// A row of summary.csv. An empty value is NaN.
struct SummaryRow {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  std::string metric;
  std::string subject;
  double value = 0.0;
  std::string unit;
  std::int64_t count = 0;
};

/// First line of summary.csv, and the lines of one cell.
std::string summary_header();
std::string summary_lines(const CellKey& key, const std::vector<metrics::MetricRow>& rows);

std::vector<SummaryRow> load_summary(const std::filesystem::path& path);

}  // namespace scanbench::runs
