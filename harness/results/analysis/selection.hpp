// Tells which cells of a run were requested: all, or those that the option --only names.
#pragma once

#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::results {

/// True unless the run's command line restricts it with --only to other cells.
bool was_selected(const runs::Manifest& manifest, const runs::CellKey& key);

}  // namespace scanbench::results
