// Figures and reports of a run, from the files in its folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/results/document/document.hpp"
#include "harness/results/pages/page_input.hpp"
#include "harness/runs/store/run_file.hpp"

namespace scanbench::results {

inline const runs::RunFile kReportPage("report.html");
inline const runs::RunFile kReportMarkdown("report.md");

/// Reads the contents of the reports from the run folder, and computes rankings and tables. Throws ConfigError.
ReportInput load_report_input(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios);

/// Draws the figures of the benchmark, if the run is one, and those of the scenarios. Then writes their index.json and,
/// if they are in the run folder, the manifest's list of files.
void draw_run_figures(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                      const FigureOptions& options = {},
                      const std::function<void(double, const std::string&)>& progress = {});

/// What a run prints at its end: the ranking of a benchmark, else the tables of every scenario.
Document closing_document(const ReportInput& input);

/// Writes report.html and report.md and the manifest's list of files. Returns the sentence with which the pages begin,
/// in one line.
std::string write_reports(const std::filesystem::path& run, const ReportInput& input);

}  // namespace scanbench::results
