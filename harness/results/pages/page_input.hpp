// The contents of a report, computed once from the files of a run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/analysis/method_ranking.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/figures/worst_scans.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/results/tables/scenario_tables.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

struct ReportInput {
  std::filesystem::path run;                               ///< figures are read from run/figures
  std::vector<std::pair<std::string, std::string>> facts;  ///< "commit", "compiler", ...: shown at the end
  std::vector<study::Scenario> scenarios;
  std::vector<runs::SummaryRow> rows;
  std::vector<CellLine> cells;
  std::vector<FigureFile> figures;
  std::map<std::string, MethodRanking> rankings = {};   ///< by scenario: of its pipelines; empty for a benchmark
  std::map<std::string, std::string> sources = {};      ///< of recorded scenarios: the log's hash and beam angles
  std::optional<study::BenchmarkSpec> benchmark = {};   ///< if the run is one
  std::vector<RankedPipeline> ranking = {};             ///< of the benchmark's pipelines
  std::vector<PipelineWorst> worst = {};                ///< of a benchmark of extractors: benchmark_worst_scans()
  std::map<std::string, ScenarioResults> results = {};  ///< by scenario; empty for a benchmark
};

}  // namespace scanbench::results
