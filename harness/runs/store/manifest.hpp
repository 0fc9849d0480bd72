// manifest.json: the command, program and machine of a run. It names artefacts.sha256, the list of the run's files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/files/hash_list.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::runs {

inline const RunFile kManifestFile("manifest.json");
/// The SHA-256 of every other file of the run, as `sha256sum -c` reads it. The manifest has the hash of this list, and
/// names no list before it is in place or while another one is.
inline const RunFile kArtefactsFile("artefacts.sha256");

/// The part of manifest.json that differs between runs. The file also has version, commit, compiler, libraries and CPU.
struct Manifest {
  std::string state;  ///< running, complete, incomplete, interrupted
  std::string start;  ///< UTC, ISO 8601
  std::string end;    ///< empty while running
  std::vector<std::string> argv;
  std::vector<std::string> scenarios;  ///< in order
  std::vector<CellKey> cells;          ///< all planned cells, in the order of summary.csv
  /// Of files that were read or written during this run, had this SHA-256, and were not written since. They are not
  /// read again for the list of files.
  io::FileHashes verified{};
  /// What keeps cells from each other and from the machine: limits and sandboxes that were active.
  std::vector<std::string> isolation{};
  /// What is active and what is not, for "programs", "libraries" and the "cells" of both: {"no network", true}. Only of
  /// those that the run has.
  std::map<std::string, std::map<std::string, bool>> sandbox{};
  /// Foreign modules that had the rights of the user, as in `foreign_modules` up to the version.
  std::vector<std::string> without_sandbox{};
  /// What programs and libraries that are not part of scanbench say of their modules, with versions.
  std::vector<std::string> foreign_modules{};
};

std::string utc_now();

/// The version of the code that made a result, computed once: the hash of the running executable without the commit
/// that is written in it. A commit of documentation gives the same program, and its results stay valid; any other
/// change of the executable, of the compiler or of its options too, is another version.
const std::string& code_version();

/// Writes manifest.json of a run that is still running, and removes the list of files of an earlier run; otherwise
/// writes the list, then manifest.json.
void write_manifest(const std::filesystem::path& run, const Manifest& manifest);
/// Throws ConfigError if there is no manifest or another program wrote it.
Manifest load_manifest(const std::filesystem::path& run);
/// The hashes in artefacts.sha256, by path relative to the run; empty if the manifest names no list, because the run
/// was killed or an earlier version of the program made it. The files themselves are not read. Throws ConfigError if
/// the list is not the one that the manifest names.
io::FileHashes listed_hashes(const std::filesystem::path& run);
/// Updates the list of files, after figures or reports were added to a run. If it was damaged, all files are read.
void refresh_manifest(const std::filesystem::path& run);

/// Changes the state and nothing else.
void set_run_state(const std::filesystem::path& run, const std::string& state);

/// "scanbench 0.1.0 (commit, compiler, build type)".
std::string version_text();

/// What made a run. Comparisons name the entries that differ.
struct Provenance {
  std::string commit;     ///< with "-dirty-" and a hash of the code if the tree had changes
  std::string compiler;   ///< with its flags
  std::string libraries;  ///< "Eigen 3.4.0, ..."
  std::string processor;
  std::string start;    ///< UTC, ISO 8601
  std::string command;  ///< the command line
};
/// From manifest.json. Throws ConfigError.
Provenance load_provenance(const std::filesystem::path& run);

/// Facts about a run for its report, as name and value, from manifest.json. Throws ConfigError.
std::vector<std::pair<std::string, std::string>> manifest_facts(const std::filesystem::path& run);

}  // namespace scanbench::runs
