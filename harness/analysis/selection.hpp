// Tells which cells of a run were requested: all, or those that the option --only names.
#pragma once

#include "harness/store/manifest.hpp"
#include "harness/store/run_folder.hpp"

namespace scanbench::harness {

/// True unless the run's command line restricts it with --only to other cells.
bool was_selected(const Manifest& manifest, const CellKey& key);

}  // namespace scanbench::harness
