// The work of one cell, done in a child process: runs a pipeline and writes its files into an unfinished folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/runs/store/traces.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/trace_choice.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

struct CellOutput {
  std::string remarks;  ///< of the pipeline, and refusals of metrics
  std::vector<metrics::MetricRow> rows;
};

/// Runs the pipeline, scores it with the scenario's metrics, and writes all files of the cell but status.json. A
/// program in the sandbox sees nothing of the folder `root` but one of its own, which is removed after it. Throws
/// what run_pipeline() and score_cell() throw.
CellOutput make_cell(const std::filesystem::path& folder, const std::filesystem::path& root,
                     const study::Scenario& scenario, const study::PipelineSpec& pipeline,
                     const study::TraceChoice& trace, const Recording& recording);

}  // namespace scanbench::runs
