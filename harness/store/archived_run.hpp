// A run whose cells are in archives: a merged sweep of so many cells that their files would be too many.
//
// Such a run has cells.csv and recordings.csv, which say where the files of every cell and recording are in
// archives/*.tar. Some cells may have their folders too, as in any run: those that were unpacked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/store/cell_archive.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/run_file.hpp"
#include "harness/store/run_folder.hpp"

namespace scanbench::harness {

inline const RunFile kCellTable("cells.csv");
inline const RunFile kRecordingTable("recordings.csv");
inline const RunFile kArchiveFiles("archives/*.tar");

struct ArchivedCell {
  CellKey key;
  CellRecord record;
  double scan_seconds = 0.0;  ///< of all stages, per scan; NaN: not known
  std::string archive;        ///< the name of a file in archives/
  ArchivePart part;
};

struct ArchivedRecording {
  std::string scenario;
  std::uint64_t seed = 0;
  std::string content_hash;
  std::string archive;
  ArchivePart part;
};

struct ArchiveTables {
  std::vector<ArchivedCell> cells;
  std::vector<ArchivedRecording> recordings;
};

/// True if the run keeps its cells in archives.
bool has_archives(const std::filesystem::path& run);

std::filesystem::path archive_path(const std::filesystem::path& run, const std::string& name);

void write_archive_tables(const std::filesystem::path& run, const ArchiveTables& tables);
/// Throws ConfigError.
ArchiveTables load_archive_tables(const std::filesystem::path& run);

/// Throws ConfigError with the command that unpacks them if the files of this cell, or of any, are in an archive only.
void require_cell(const std::filesystem::path& run, const CellKey& key);
void require_all_cells(const std::filesystem::path& run);

/// What became of the cells of a run: from the table of an archived run, else from status.json of each cell.
class CellRecords {
 public:
  explicit CellRecords(const std::filesystem::path& run);
  /// Nothing for a cell that is missing.
  std::optional<CellRecord> of(const CellKey& key) const;

 private:
  std::filesystem::path run_;
  std::optional<std::map<CellKey, CellRecord>> table_;
};

/// Writes the folders of these cells and their recordings into an archived run, whose lock the caller has; those that
/// exist are kept. Returns how many cells were written. With all cells unpacked it is an ordinary run: the archives and
/// their tables are removed. Throws ConfigError for a cell that the run does not have and for a damaged archive.
std::size_t unpack_cells(const std::filesystem::path& run, const std::vector<CellKey>& keys,
                         const std::function<void(double share)>& progress = {});

}  // namespace scanbench::harness
