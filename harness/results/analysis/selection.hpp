// What the command line of a run requested: all cells, or those that --only names, with the overrides of --set.
#pragma once

#include <string>
#include <vector>

#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::results {

/// True unless the run's command line restricts it with --only to other cells.
bool was_selected(const runs::Manifest& manifest, const runs::CellKey& key);

/// The overrides "key=value" of the run's command line.
std::vector<std::string> overrides_of(const runs::Manifest& manifest);

}  // namespace scanbench::results
