// Runs and scores one pipeline on one recording, and writes the files of the cell.
#include "harness/runs/execute/cell_work.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/runs/store/cell_files.hpp"

namespace scanbench::runs {

namespace {

/// A module may have made links, pipes or files there, which would be taken for results.
void remove_leftovers(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) left.push_back(entry.path());
  for (const auto& path : left) std::filesystem::remove_all(path);
}

}  // namespace

CellOutput make_cell(const std::filesystem::path& folder, const std::filesystem::path& root,
                     const study::Scenario& scenario, const study::PipelineSpec& pipeline,
                     const study::TraceChoice& trace, const Recording& recording) {
  Journal journal(trace);
  const bool traced = !trace.nothing();
  const PipelineRun run =
      run_pipeline(pipeline, recording.observed, traced ? &journal : nullptr,
                   {.sandbox = scenario.limits.sandbox, .writable_folder = folder, .hidden_folder = root});
  remove_leftovers(folder);
  write_result(folder, pipeline, run.result);
  if (traced) io::write_staged_file(folder / kTraceFile, journal.csv());
  Scores scores = score_cell(scenario.metrics, recording, folder);
  io::write_staged_file(folder / kMetricsFile, metrics_csv(scores.rows));
  for (const auto& table : scores.tables)
    io::write_staged_file(folder / (table.name + ".csv"), metric_table_csv(table));
  return {run.remarks, std::move(scores.rows)};
}

}  // namespace scanbench::runs
