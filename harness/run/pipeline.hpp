// Executes the slots of a pipeline on the scans of a recording, through the registries.
#pragma once

#include <string>

#include "core/result.hpp"
#include "core/scan.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/traces.hpp"

namespace scanbench::harness {

struct PipelineRun {
  PipelineResult result;
  std::string remarks;  ///< outcomes other than `converged`, with counts: "match: 2 no_match, 1 degenerate"
};

/// `extract` runs on every frame, unless the scan set holds lines in place of scans: the chain then begins after it.
/// `align` gets all scans and their odometry; `match` chains consecutive scans, each
/// guess being the odometry between them (which is kept where the matcher says no_match); `map` gets scan after scan
/// with its pose; `merge` gets the lines and the valid points placed in the world. Poses are those of the last slot
/// that estimates them (`map`, else `align` or `match`), else the odometry.
///
/// Results come from a pass in which nobody listens to `extract`; its stage times from a second pass (microseconds a
/// scan). The other slots are timed while they work: a second pass of them could take as long as the first. Stages of
/// `extract` keep their names, those of the other slots get `<slot>.` in front. A journal, if given, listens to a pass
/// of its own over all slots.
///
/// Throws ConfigError for an unknown module or chain, ParamError for its parameters, InvalidResult, and what the
/// modules throw.
PipelineRun run_pipeline(const PipelineSpec& pipeline, const ScanSet& scans, Journal* journal = nullptr);

}  // namespace scanbench::harness
