// manifest.json: what was run, with which program, on which machine, and every file that came of it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/store/run_folder.hpp"

namespace scanbench::harness {

/// manifest.json, less what is the same for every run of this program (version, commit, compiler, libraries, CPU).
struct Manifest {
  std::string state;  ///< running, complete, incomplete, interrupted
  std::string start;  ///< UTC, ISO 8601
  std::string end;    ///< empty while running
  std::vector<std::string> argv;
  std::vector<std::string> scenarios;  ///< in order
  std::vector<CellKey> cells;          ///< every cell that the run is to have, in the order of summary.csv
};

std::string utc_now();

/// Writes manifest.json; with the list of all files and their SHA-256 unless the run is still going on.
void write_manifest(const std::filesystem::path& run, const Manifest& manifest);
/// Throws ConfigError if there is no manifest or it is not one of ours.
Manifest load_manifest(const std::filesystem::path& run);
/// The SHA-256 of the files that manifest.json lists, by their path relative to the run; none if the run was killed.
/// The files themselves are not read. Throws ConfigError if there is no manifest or it is not one of ours.
std::map<std::string, std::string> listed_hashes(const std::filesystem::path& run);
/// Lists the files anew: after figures or reports were added to a run.
void refresh_manifest(const std::filesystem::path& run);

/// Changes the state and nothing else.
void set_run_state(const std::filesystem::path& run, const std::string& state);

/// "scanbench 0.1.0 (commit, compiler, build type)".
std::string version_text();

/// What a report says about how a run came about: name and value, from manifest.json. Throws ConfigError.
std::vector<std::pair<std::string, std::string>> manifest_facts(const std::filesystem::path& run);

}  // namespace scanbench::harness
