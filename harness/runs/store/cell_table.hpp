// The tables that say which part of an archive each cell and each recording is: cells.csv and recordings.csv of a shard
// that is committed, and of a run that keeps its cells in archives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/store/cell_archive.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::runs {

inline const RunFile kCellTable("cells.csv");
inline const RunFile kRecordingTable("recordings.csv");

struct ArchivedCell {
  CellKey key;
  CellRecord record;
  double scan_seconds = 0.0;  ///< of all stages, per scan; NaN: not known
  /// SHA-256 of what must be equal each time the cell is made: not timing.csv, the times and memory in status.json, and
  /// the metrics t_*. Empty in tables of merged runs that an earlier version wrote.
  std::string result;
  /// Its lines in the summary.csv beside the table. Where they begin follows from the order of the cells.
  std::size_t summary_begin = 0;
  std::size_t summary_size = 0;
  std::string archive;  ///< the name of a file
  ArchivePart part;
};

struct ArchivedRecording {
  std::string scenario;
  std::uint64_t seed = 0;
  std::string content_hash;
  std::string archive;
  ArchivePart part;
};

struct CellTable {
  std::vector<ArchivedCell> cells;            ///< in the order of summary.csv
  std::vector<ArchivedRecording> recordings;  ///< by scenario and seed, ascending

  /// Null if it is not listed.
  const ArchivedRecording* recording(const std::string& scenario, std::uint64_t seed) const;
};

std::string cells_csv(const std::vector<ArchivedCell>& cells);
std::string recordings_csv(const std::vector<ArchivedRecording>& recordings);

/// The table of both texts; messages name the files as those of this folder. Throws ConfigError.
CellTable parse_cell_table(std::string cells, std::string recordings, const std::filesystem::path& folder);

}  // namespace scanbench::runs
