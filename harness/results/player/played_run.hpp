// The scans of a run and the lines found in them, as a page holds them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "harness/runs/store/run_store.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// What one page holds at most.
struct PlayerLimits {
  std::size_t scans = 2000;                           ///< of a recording
  std::size_t bytes = std::size_t{24} * 1024 * 1024;  ///< of all recordings, as written into the page
};

/// Recordings with the scans that must be in the page even where others are left out.
using PlayedRecordings = std::map<runs::RunStore::RecordingKey, std::set<std::size_t>>;

/// Reads every scenario with scans and a finished cell: ranges, and of each pipeline the lines, the share of returns
/// that support none, the root mean square distance of the others from theirs and, if the cell has a scans.csv, its F1;
/// of a simulated recording also the true walls and the true poses. Of the first seed of each scenario and of the
/// recordings in `chosen`; without such a choice of all seeds, if the limits hold all their scans. Lengths are whole
/// numbers of steps, in base64, those of walls metres. An empty array if the run has no scans with lines. Throws
/// ConfigError for damaged files.
nlohmann::ordered_json played_run(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                                  const PlayerLimits& limits = {}, const std::optional<PlayedRecordings>& chosen = {});

}  // namespace scanbench::results
