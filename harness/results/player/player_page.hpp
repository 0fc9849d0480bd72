// A page that plays the scans of a run with the lines of every pipeline over them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/player/played_run.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

inline const runs::RunFile kPlayerPage("scans.html");

/// Self-contained HTML with a canvas, a slider and keys, and true walls as a layer. Where the limits leave scans out,
/// the page says how many. Throws ConfigError if the run has no scans with lines.
std::string player_page(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                        const PlayerLimits& limits = {});

/// Writes this page into the run folder, of the first seed of each scenario and of these recordings; false if the run
/// has no scans with lines, and then no such page remains. Throws ConfigError for damaged files.
bool write_player(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                  const PlayedRecordings& recordings);

/// The relative address of a scan of a cell on this page: "scans.html#room/iepf/7/15".
std::string player_address(const runs::CellKey& key, std::size_t frame);

}  // namespace scanbench::results
