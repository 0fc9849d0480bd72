// A page that plays the scans of a run with the lines of every pipeline over them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/player/played_run.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

inline const runs::RunFile kPlayerPage("scans.html");

/// Self-contained HTML with a canvas, a slider and keys. Where the limits leave scans out, the page says how many.
/// Throws ConfigError if the run has no scans with lines.
std::string player_page(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                        const PlayerLimits& limits = {});

}  // namespace scanbench::results
