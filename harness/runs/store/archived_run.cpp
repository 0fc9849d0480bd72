// Writes and reads the tables of an archived run, and unpacks its cells.
#include "harness/runs/store/archived_run.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/runs/store/manifest.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostOpenArchives = 64;

/// The chosen cells; throws for a key that the run does not have.
std::vector<const ArchivedCell*> choose_cells(const fs::path& run, const RunArchives& archives,
                                              const std::vector<CellKey>& keys) {
  std::vector<const ArchivedCell*> chosen;
  for (const auto& key : keys) {
    chosen.push_back(archives.cell(key));
    if (chosen.back() == nullptr) throw ConfigError(run.string() + " has no cell " + to_string(key));
  }
  return chosen;
}

template <class Archived>
void write_folder(const fs::path& folder, const RunArchives& archives, const Archived& archived) {
  if (fs::exists(folder)) return;
  io::StagedFolder staged(folder);
  for (const auto& [name, bytes] : archives.files(archived)) io::write_staged_file(staged.path() / name, bytes);
  staged.place();
}

/// True if the archives of a run are being removed, or were when the program was killed.
bool is_half_unpacked(const fs::path& run) {
  std::error_code absent;
  if (fs::exists(run / kRecordingTable, absent) || fs::exists(run / "archives", absent)) return true;
  if (!fs::exists(run / kManifestFile, absent) || load_manifest(run).state != "complete") return false;
  const io::FileHashes listed = listed_hashes(run);  // empty: killed while the list was written
  return listed.empty() || listed.contains(kCellTable.name());
}

void remove_archives(const fs::path& run) {
  io::remove_file(run / kCellTable);  // from here on, the run is an ordinary one
  io::remove_file(run / kRecordingTable);
  for (const auto& name : io::names_in(run / "archives"))
    if (is_run_file(fs::path("archives") / name)) io::remove_file(run / "archives" / name);
  std::error_code not_empty;
  fs::remove(run / "archives", not_empty);
  refresh_manifest(run);
}

}  // namespace

bool has_archives(const fs::path& run) {
  std::error_code absent;
  return fs::exists(run / kCellTable, absent);
}

fs::path archive_path(const fs::path& run, const std::string& name) {
  return run / "archives" / io::check_name("archive", name);
}

void write_archive_tables(const fs::path& run, const CellTable& table) {
  io::write_file_atomically(run / kRecordingTable, recordings_csv(table.recordings));
  io::write_file_atomically(run / kCellTable, cells_csv(table.cells));
}

RunArchives::RunArchives(fs::path run)
    : run_(std::move(run)),
      table_(parse_cell_table(io::read_file(run_ / kCellTable), io::read_file(run_ / kRecordingTable), run_)) {
  for (std::size_t i = 0; i < table_.cells.size(); ++i) places_.emplace(table_.cells[i].key, i);
}

const ArchivedCell* RunArchives::cell(const CellKey& key) const {
  const auto found = places_.find(key);
  return found == places_.end() ? nullptr : &table_.cells[found->second];
}

FolderFiles RunArchives::files(const ArchivedCell& cell) const {
  return files(cell.archive, cell.part, cell_path("", cell.key));
}

FolderFiles RunArchives::files(const ArchivedRecording& recording) const {
  return files(recording.archive, recording.part, recording_path("", recording.scenario, recording.seed));
}

FolderFiles RunArchives::files(const std::string& archive, const ArchivePart& part, const fs::path& folder) const {
  if (readers_.size() >= kMostOpenArchives && !readers_.contains(archive)) readers_.clear();
  return readers_.try_emplace(archive, archive_path(run_, archive)).first->second.files(part, folder);
}

std::size_t unpack_cells(const fs::path& run, const std::vector<CellKey>& keys,
                         const std::function<void(double)>& progress) {
  io::remove_temporaries(run);
  if (!has_archives(run)) {
    if (!is_half_unpacked(run)) throw ConfigError(run.string() + " has no archives: its cells are files");
    remove_archives(run);
    return 0;
  }
  const RunArchives archives(run);
  const auto is_unpacked = [&](const ArchivedCell& cell) { return fs::exists(cell_path(run, cell.key)); };
  std::size_t written = 0;
  const auto chosen = choose_cells(run, archives, keys);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const CellKey& key = chosen[i]->key;
    if (progress) progress(static_cast<double>(i) / static_cast<double>(chosen.size()));
    if (const ArchivedRecording* recording = archives.table().recording(key.scenario, key.seed))
      write_folder(recording_path(run, key.scenario, key.seed), archives, *recording);
    if (!is_unpacked(*chosen[i])) ++written;
    write_folder(cell_path(run, key), archives, *chosen[i]);
  }
  io::flush_file_system(run);
  if (std::ranges::all_of(archives.table().cells, is_unpacked))
    remove_archives(run);
  else
    refresh_manifest(run);
  return written;
}

}  // namespace scanbench::runs
