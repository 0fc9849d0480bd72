// Runs and scores one pipeline on one recording, and writes the files of the cell.
#include "harness/run/cell_work.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "harness/files/atomic_file.hpp"
#include "harness/run/pipeline.hpp"
#include "harness/run/score.hpp"
#include "harness/store/cell_files.hpp"

namespace scanbench::harness {

namespace {

/// A module may have made links, pipes or files there, which would be taken for results.
void remove_leftovers(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) left.push_back(entry.path());
  for (const auto& path : left) std::filesystem::remove_all(path);
}

}  // namespace

CellOutput make_cell(const std::filesystem::path& folder, const std::filesystem::path& root, const Scenario& scenario,
                     const PipelineSpec& pipeline, const TraceChoice& trace, const Recording& recording) {
  Journal journal(trace);
  const bool traced = !trace.nothing();
  const PipelineRun run =
      run_pipeline(pipeline, recording.observed, traced ? &journal : nullptr,
                   {.sandbox = scenario.limits.sandbox, .writable_folder = folder, .hidden_folder = root});
  remove_leftovers(folder);
  write_result(folder, pipeline, run.result);
  if (traced) write_staged_file(folder / kTraceFile, journal.csv());
  Scores scores = score_cell(scenario.metrics, recording, folder);
  write_staged_file(folder / kMetricsFile, metrics_csv(scores.rows));
  for (const auto& table : scores.tables) write_staged_file(folder / (table.name + ".csv"), metric_table_csv(table));
  return {run.remarks, std::move(scores.rows)};
}

}  // namespace scanbench::harness
