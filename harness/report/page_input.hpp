// The contents of a report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/analysis/method_ranking.hpp"
#include "harness/report/figures.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

/// A cell as the report lists it.
struct CellLine {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  std::string status;   ///< a name of CellStatus, or "missing"
  std::string message;  ///< why it failed; of a cell that is ok, the remarks of its pipeline
  double wall_seconds = 0.0;
  double peak_memory_bytes = 0.0;
  bool selected = true;  ///< false: the run was restricted to other cells, and this one does not exist
};

struct ReportInput {
  std::filesystem::path run;  ///< figures are read from run/figures
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "commit", "compiler", ...: shown at the end
  std::vector<Scenario> scenarios;
  std::vector<SummaryRow> rows;
  std::vector<CellLine> cells;
  std::vector<FigureFile> figures;
  std::map<std::string, MethodRanking> rankings = {};  ///< by scenario: of its pipelines
  std::map<std::string, std::string> sources = {};     ///< of recorded scenarios: the log's hash and beam angles
};

}  // namespace scanbench::harness
