// The report of a run: one self-contained HTML page and the same in Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures.hpp"
#include "harness/results_table.hpp"
#include "harness/scenario.hpp"

namespace scanbench::harness {

/// A cell as the report lists it.
struct CellLine {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  std::string status;
  std::string message;
  double wall_seconds = 0.0;
  double peak_memory_bytes = 0.0;
};

struct ReportInput {
  std::filesystem::path run;  ///< figures are read from run/figures
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "commit", "compiler", ...: shown at the end
  std::vector<Scenario> scenarios;
  std::vector<SummaryRow> rows;
  std::vector<CellLine> cells;
  std::vector<FigureFile> figures;
};

/// HTML with styles and figures inside: it can be mailed. SVG figures are embedded as data, so their ids cannot meet.
std::string report_html(const ReportInput& input);

std::string report_markdown(const ReportInput& input);

}  // namespace scanbench::harness
