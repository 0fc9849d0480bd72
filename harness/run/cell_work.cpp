// Runs and scores one pipeline on one recording, and writes the files of the cell.
#include "harness/run/cell_work.hpp"

#include <utility>

#include "harness/files/atomic_file.hpp"
#include "harness/run/pipeline.hpp"
#include "harness/run/score.hpp"
#include "harness/store/cell_files.hpp"

namespace scanbench::harness {

CellOutput make_cell(const std::filesystem::path& folder, const Scenario& scenario, const PipelineSpec& pipeline,
                     const TraceChoice& trace, const Recording& recording) {
  Journal journal(trace);
  const bool traced = !trace.nothing();
  const PipelineRun run = run_pipeline(pipeline, recording.observed, traced ? &journal : nullptr);
  write_result(folder, pipeline, run.result);
  if (traced) write_staged_file(folder / kTraceFile, journal.csv());
  Scores scores = score_cell(scenario.metrics, recording, folder);
  write_staged_file(folder / kMetricsFile, metrics_csv(scores.rows));
  for (const auto& table : scores.tables) write_staged_file(folder / (table.name + ".csv"), metric_table_csv(table));
  return {run.remarks, std::move(scores.rows)};
}

}  // namespace scanbench::harness
