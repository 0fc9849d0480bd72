// Executes the slots of a pipeline on the scans of a recording, through the registries.
#pragma once

#include <string>

#include "core/result.hpp"
#include "core/scan.hpp"
#include "harness/runs/store/traces.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"

namespace scanbench::runs {

struct PipelineRun {
  PipelineResult result;
  std::string remarks;  ///< outcomes other than `converged`, with counts: "match: 2 no_match, 1 degenerate"
};

/// `extract` runs on every frame, unless the scan set has lines instead of scans; the chain then begins after it.
/// `align` gets all scans and their odometry; `match` chains consecutive scans, with the odometry between them as the
/// guess (and as the result if the matcher returns no_match). Without odometry, if all scans have one odometry pose,
/// the guess is the step before; the first one is not a motion. `map` gets one scan after the other with its pose;
/// `merge` gets the lines and the valid points placed in the world. Poses are those of the
/// last slot that estimates them (`map`, else `align` or `match`), else the odometry.
///
/// `extract` runs twice: results come from a pass without a listener, stage times [us per scan] from a second pass. The
/// other slots are timed in the first pass, because a second one could take as long. Stages of `extract` keep their
/// names, those of the other slots begin with `<slot>.`. A journal, if given, records a separate pass over all slots.
///
/// `skip_matches`: so many scans at most, evenly spread, are also matched with the last but one, from the odometry
/// between them (without odometry, from twice the step before). These matches move no pose and are not timed.
///
/// Throws ConfigError for an unknown module or chain, ParamError for its parameters, InvalidResult, and what the
/// modules throw. Faults of foreign modules name the slot and the frame.
PipelineRun run_pipeline(const study::PipelineSpec& pipeline, const ScanSet& scans, Journal* journal = nullptr,
                         const study::ForeignSetting& foreign = {}, int skip_matches = 0);

}  // namespace scanbench::runs
