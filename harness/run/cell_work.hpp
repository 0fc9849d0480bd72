// The work of one cell, done in a child process: runs a pipeline and writes its files into an unfinished folder.
#pragma once

#include <filesystem>
#include <string>

#include "core/recording.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario/trace_choice.hpp"
#include "harness/store/traces.hpp"

namespace scanbench::harness {

/// Runs the pipeline, scores it with the scenario's metrics, and writes all files of the cell but status.json. Returns
/// the pipeline's remarks. Throws what run_pipeline() and score_cell() throw.
std::string make_cell(const std::filesystem::path& folder, const Scenario& scenario, const PipelineSpec& pipeline,
                      const TraceChoice& trace, const Recording& recording);

}  // namespace scanbench::harness
