// A page that plays the scans of a run with the lines of every pipeline over them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/player/played_run.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/store/run_file.hpp"

namespace scanbench::harness {

inline const RunFile kPlayerPage("scans.html");

/// Self-contained HTML with a canvas, a slider and keys. Where the limits leave scans out, the page says how many.
/// Throws ConfigError if the run has no scans with lines.
std::string player_page(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                        const PlayerLimits& limits = {});

}  // namespace scanbench::harness
