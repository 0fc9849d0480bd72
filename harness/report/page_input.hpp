// The contents of a report, computed once from the files of a run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/analysis/benchmark.hpp"
#include "harness/analysis/method_ranking.hpp"
#include "harness/report/comparable_rows.hpp"
#include "harness/report/figures.hpp"
#include "harness/report/scenario_tables.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {

struct ReportInput {
  std::filesystem::path run;  ///< figures are read from run/figures
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "commit", "compiler", ...: shown at the end
  std::vector<Scenario> scenarios;
  std::vector<SummaryRow> rows;
  std::vector<CellLine> cells;
  std::vector<FigureFile> figures;
  std::map<std::string, MethodRanking> rankings = {};   ///< by scenario: of its pipelines
  std::map<std::string, std::string> sources = {};      ///< of recorded scenarios: the log's hash and beam angles
  std::optional<BenchmarkSpec> benchmark = {};          ///< if the run is one
  std::vector<RankedPipeline> ranking = {};             ///< of the benchmark's pipelines
  std::map<std::string, ScenarioResults> results = {};  ///< by scenario; empty for a benchmark
};

}  // namespace scanbench::harness
