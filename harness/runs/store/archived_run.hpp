// A run whose cells are in archives: a merged sweep of so many cells that their files would be too many.
//
// Such a run has cells.csv and recordings.csv, which say where the files of every cell and recording are in
// archives/*.tar. Some cells may have their folders too, as in any run: those that were unpacked. What reads a run does
// so through RunStore (run_store.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/runs/store/cell_archive.hpp"
#include "harness/runs/store/cell_table.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::runs {

inline const RunFile kArchiveFiles("archives/*.tar");

/// True if the run keeps its cells in archives.
bool has_archives(const std::filesystem::path& run);

std::filesystem::path archive_path(const std::filesystem::path& run, const std::string& name);

void write_archive_tables(const std::filesystem::path& run, const CellTable& table);

/// The table of an archived run, and the files in its archives.
class RunArchives {
 public:
  /// Reads the table. Throws ConfigError.
  explicit RunArchives(std::filesystem::path run);

  const CellTable& table() const { return table_; }
  /// Null if the run does not have it.
  const ArchivedCell* cell(const CellKey& key) const;
  /// Throw ConfigError for a damaged archive.
  FolderFiles files(const ArchivedCell& cell) const;
  FolderFiles files(const ArchivedRecording& recording) const;

 private:
  FolderFiles files(const std::string& archive, const ArchivePart& part, const std::filesystem::path& folder) const;

  std::filesystem::path run_;
  CellTable table_;
  std::map<CellKey, std::size_t> places_;                 ///< of the cells in the table
  mutable std::map<std::string, ArchiveReader> readers_;  ///< of archives that are open
};

/// Writes the folders of these cells and their recordings into an archived run, whose lock the caller has; those that
/// exist are kept. Returns how many cells were written. With all cells unpacked it is an ordinary run: the archives and
/// their tables are removed; a call that was killed can be repeated. Throws ConfigError for a run without archives, for
/// a cell that the run does not have and for a damaged archive.
std::size_t unpack_cells(const std::filesystem::path& run, const std::vector<CellKey>& keys,
                         const std::function<void(double share)>& progress = {});

}  // namespace scanbench::runs
