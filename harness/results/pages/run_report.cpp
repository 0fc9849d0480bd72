// Collects the contents of reports, and writes figures and reports.
#include "harness/results/pages/run_report.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/params.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/agreement.hpp"
#include "harness/results/analysis/agreement_files.hpp"
#include "harness/results/analysis/selection.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/figures/benchmark_figures.hpp"
#include "harness/results/figures/requested_figures.hpp"
#include "harness/results/pages/benchmark_extremes.hpp"
#include "harness/results/pages/benchmark_report.hpp"
#include "harness/results/pages/report.hpp"
#include "harness/results/tables/ranking_table.hpp"
#include "harness/results/tables/scenario_tables.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"

namespace scanbench::results {

namespace fs = std::filesystem;
namespace {

// Writes published/*.csv if a scenario has values of a paper.
void write_agreement(const fs::path& run, const ReportInput& input) {
  std::vector<std::pair<std::string, std::vector<ComparedColumn>>> compared;
  for (const auto& scenario : input.scenarios)
    if (auto columns = compare_with_paper(scenario, input.rows); !columns.empty())
      compared.emplace_back(scenario.name, std::move(columns));
  if (compared.empty()) return;
  io::make_folders(run / "published");
  for (const auto& file : agreement_files(compared))
    io::write_file_atomically(run / "published" / file.name, file.bytes);
}

/// "SHA-256 ...; 180 beams from -90 deg in steps of 1 deg, from first_angle_deg and step_deg".
std::string source_of(const runs::RunStore& store, const study::Scenario& scenario,
                      const study::RecordedInput& recorded) {
  std::string text = recorded.log_sha256.empty() ? "hash not known" : "SHA-256 " + recorded.log_sha256;
  if (scenario.seeds.empty()) return text;
  const runs::StoredFiles recording = store.recording(scenario.name, scenario.seeds.front());
  if (!recording.has(runs::kScanFile)) return text;
  return runs::with_json_of(recording, runs::kScanFile, [&](const nlohmann::ordered_json& json) {
    const bool given = std::ranges::any_of(std::array{"step_deg", "span_deg"}, [&](const char* key) {
      const auto param = recorded.params.find(key);
      return param != recorded.params.end() && to_text(param->second) != "0";
    });
    return text + fmt::format("; {} beams from {:.6g} deg in steps of {:.6g} deg, {}", json.at("beams").get<int>(),
                              degrees(json.at("angle_min_rad").get<double>()),
                              degrees(json.at("angle_step_rad").get<double>()),
                              given ? "from first_angle_deg and step_deg or span_deg"
                                    : "from the log or the rule of its format for this number of beams");
  });
}

std::map<std::string, MethodRanking> rankings_by_scenario(const runs::RunStore& store, const ReportInput& input) {
  std::map<std::string, std::vector<CellResults>> cells;
  std::map<runs::CellKey, std::size_t> places;
  std::vector<CellResults> all;  // without rows
  for (const auto& line : input.cells) {
    auto& of_scenario = cells[line.scenario];
    const runs::CellKey key{line.scenario, line.pipeline, line.seed};
    places[key] = of_scenario.size();
    CellResults& cell = of_scenario.emplace_back();
    cell.key = key;
    cell.requested = line.selected;
    cell.status = line.status;
    all.push_back(cell);
  }
  const std::map<runs::CellKey, double> seconds = load_scan_seconds(store, all);
  for (const auto& row : input.rows) {
    const auto place = places.find({row.scenario, row.pipeline, row.seed});
    if (place == places.end()) continue;
    metrics::MetricRow& copy = cells[row.scenario][place->second].rows.emplace_back();
    copy.metric = row.metric;
    copy.subject = row.subject;
    copy.value = row.value;
    copy.unit = row.unit;
    copy.count = row.count;
  }
  std::map<std::string, MethodRanking> rankings;
  for (const auto& [scenario, of_scenario] : cells)
    for (auto& ranking : rank_methods(of_scenario, seconds)) rankings.emplace(scenario, std::move(ranking));
  return rankings;
}

}  // namespace

ReportInput load_report_input(const fs::path& run, const std::vector<study::Scenario>& scenarios) {
  ReportInput input;
  input.run = run;
  input.facts = runs::manifest_facts(run);
  input.scenarios = scenarios;
  if (fs::exists(run / runs::kSummaryFile)) input.rows = runs::load_summary(run / runs::kSummaryFile);
  const runs::Manifest manifest = runs::load_manifest(run);
  const runs::RunStore store(run);
  for (const auto& key : manifest.cells) {
    CellLine line{key.scenario, key.pipeline, key.seed, "missing", "not run", 0.0, 0.0, was_selected(manifest, key)};
    if (const auto record = store.record(key)) {
      line.selected = true;
      line.status = runs::to_string(record->outcome.status);
      line.message = plain_line(record->outcome.message);
      line.wall_seconds = record->outcome.wall_seconds;
      line.peak_memory_bytes = record->outcome.peak_memory_bytes;
      const std::string folder = "cells/" + runs::to_string(key) + "/";
      if (fs::is_directory(run / folder)) line.folder = folder;  // a merged run may keep its cells in archives
    }
    input.cells.push_back(std::move(line));
  }
  input.figures = load_figure_index(run / "figures");
  for (const auto& scenario : scenarios)
    if (const auto* recorded = std::get_if<study::RecordedInput>(&scenario.input))
      input.sources[scenario.name] = source_of(store, scenario, *recorded);
  input.benchmark = runs::load_benchmark(run, scenarios);
  if (input.benchmark) {
    input.ranking = rank_pipelines(scenarios, input.rows, *input.benchmark);
    input.worst = benchmark_worst_scans(input);
  } else {
    input.rankings = rankings_by_scenario(store, input);
    for (const auto& scenario : scenarios)
      input.results[scenario.name] = scenario_results(scenario, input.rows, input.cells);
  }
  return input;
}

void draw_run_figures(const fs::path& run, const std::vector<study::Scenario>& scenarios, const FigureOptions& options,
                      const std::function<void(double, const std::string&)>& progress) {
  const runs::RunStore store(run);
  std::vector<FigureFile> figures;
  const auto benchmark = runs::load_benchmark(run, scenarios);
  if (benchmark && options.figures.empty())
    figures = draw_benchmark_figures(store, scenarios, *benchmark, options, progress);
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const auto part = [&](double share, const std::string& what) {
      if (progress) progress((static_cast<double>(i) + share) / static_cast<double>(scenarios.size()), what);
    };
    for (auto& figure : draw_figures(store, scenarios[i], options, part)) figures.push_back(std::move(figure));
  }
  for (auto& figure : draw_run_wide_figures(store, scenarios, options)) figures.push_back(std::move(figure));
  const fs::path folder = figure_folder(run, options);
  save_figure_index(folder, options.figures.empty() ? figures : beside(load_figure_index(folder), figures));
  if (options.folder.empty()) runs::refresh_manifest(run);
  require_drawn(options.figures, figures);
}

Document closing_document(const ReportInput& input) {
  Document document;
  if (input.benchmark) document.blocks.push_back(ranking_table(input.ranking, *input.benchmark));
  for (const auto& scenario : input.scenarios)
    if (const auto results = input.results.find(scenario.name); results != input.results.end())
      for (const auto& table : results->second.tables)
        if (!table.pages_only) document.blocks.push_back(table);
  return document;
}

std::string write_reports(const fs::path& run, const ReportInput& input) {
  write_agreement(run, input);  // before the page, which links to it
  const Document page = input.benchmark ? benchmark_document(input) : report_document(input);
  io::write_file_atomically(run / kReportPage, to_html(page));
  io::write_file_atomically(run / kReportMarkdown, to_markdown(page));
  runs::refresh_manifest(run);
  std::string lead;
  for (const TextSpan& span : page.lead.spans) lead += span.text;
  return lead;
}

}  // namespace scanbench::results
