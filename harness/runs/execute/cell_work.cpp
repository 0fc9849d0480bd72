// Runs and scores one pipeline on one recording, and writes the files of the cell.
#include "harness/runs/execute/cell_work.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/runs/store/cell_files.hpp"

namespace scanbench::runs {

namespace {

/// A program of the pipeline runs in a folder of its own, which is removed with all that it leaves there: none of it is
/// taken for a result.
PipelineRun run_in_own_folder(const std::filesystem::path& folder, const std::filesystem::path& root,
                              const study::Scenario& scenario, const study::PipelineSpec& pipeline,
                              const Recording& recording, Journal* journal) {
  const io::StagedFolder own(folder / "module");  // never committed
  return run_pipeline(pipeline, recording.observed, journal,
                      {.sandbox = scenario.limits.sandbox, .writable_folder = own.path(), .hidden_folder = root},
                      skip_matches_requested(scenario.metrics));
}

/// Whatever a library, or a program outside of the sandbox, has put into the cell's folder is not taken for a result.
void clear_folder(const std::filesystem::path& folder) {
  for (const std::string& name : io::names_in(folder)) {
    std::error_code error;
    std::filesystem::remove_all(folder / name, error);
    if (error) throw io::SystemError("cannot remove " + (folder / name).string() + ": " + error.message());
  }
}

}  // namespace

CellOutput make_cell(const std::filesystem::path& folder, const std::filesystem::path& root,
                     const study::Scenario& scenario, const study::PipelineSpec& pipeline,
                     const study::TraceChoice& trace, const Recording& recording) {
  Journal journal(trace);
  const bool traced = !trace.nothing();
  const PipelineRun run = run_in_own_folder(folder, root, scenario, pipeline, recording, traced ? &journal : nullptr);
  clear_folder(folder);
  write_result(folder, pipeline, run.result);
  if (traced) io::write_staged_file(folder / kTraceFile, journal.csv());
  Scores scores = score_cell(scenario.metrics, recording, folder);
  io::write_staged_file(folder / kMetricsFile, metrics_csv(scores.rows));
  for (const auto& table : scores.tables)
    io::write_staged_file(folder / (table.name + ".csv"), metric_table_csv(table));
  return {message_with(run.remarks, scores.refusals), std::move(scores.rows)};
}

}  // namespace scanbench::runs
