// After the cells: figures and reports of a run folder, from its files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/report/page_input.hpp"
#include "harness/report/table.hpp"
#include "harness/store/run_file.hpp"

namespace scanbench::harness {

inline const RunFile kReportPage("report.html");
inline const RunFile kReportMarkdown("report.md");

/// All that the reports show, read from the run folder. Throws ConfigError.
ReportInput load_report_input(const std::filesystem::path& run, const std::vector<Scenario>& scenarios);

/// Draws those of the benchmark, if the run is one, and all figures of the scenarios (and PDFs with `pdf`), then
/// figures/index.json and the manifest's list of files.
void draw_run_figures(const std::filesystem::path& run, const std::vector<Scenario>& scenarios, bool pdf = false,
                      const std::function<void(double, const std::string&)>& progress = {});

/// The tables that a run ends with on a terminal: the ranking of a benchmark, else those of every scenario.
std::vector<Table> closing_tables(const ReportInput& input);

/// Writes report.html and report.md and the manifest's list of files.
void write_reports(const std::filesystem::path& run, const ReportInput& input);

}  // namespace scanbench::harness
