// Appends the files of finished recordings and cells to the archive of a shard.
#include "harness/runs/sweep/archive_sink.hpp"

#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "harness/io/files/hash_list.hpp"
#include "harness/runs/store/cell_archive.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

/// What the child has written, and nothing that another process has added.
FolderFiles read_listed(const io::StagedFolder& files, const std::string& hashes) {
  return read_files(files.path(), io::parse_hash_list(hashes, files.path().string()));
}

}  // namespace

ArchiveSink::ArchiveSink(const RunPlan& plan, const fs::path& sweep, int shard)
    : plan_(plan), sweep_(sweep), writer_(sweep, shard) {}

std::string ArchiveSink::hashes_of(const fs::path& folder) const {
  return io::hash_lines(folder);
}

ArchivedCell ArchiveSink::take_cell(std::size_t cell) {
  return std::move(kept_.extract(cell).mapped());
}

fs::path ArchiveSink::commit(const std::vector<ArchivedCell>& cells, const std::string& summary) {
  std::error_code ignored;
  for (const auto& empty : std::exchange(empty_folders_, {})) fs::remove(empty, ignored);
  return writer_.commit(cells, summary);
}

io::StagedFolder ArchiveSink::stage(const fs::path& place) {
  if (!empty_folders_.empty()) {
    fs::path folder = std::move(empty_folders_.back());
    empty_folders_.pop_back();
    return io::StagedFolder::in_empty_folder(writer_.path() / place, std::move(folder));
  }
  const std::string name = "files" + std::to_string(folders_made_++);
  return {writer_.path() / name, writer_.path() / ("." + name)};
}

void ArchiveSink::keep(std::vector<FinishedRecording> recordings, std::vector<FinishedCell>& cells) {
  for (auto& recording : recordings) {
    const PlannedGroup& group = plan_.groups[recording.group];
    try {
      writer_.add_recording(group.scenario->name, group.seed, read_listed(recording.files, recording.file_hashes));
    } catch (const ConfigError& e) {
      lose_recording(recording.group, e.what());
    }
    use_again(std::move(recording.files));
  }
  for (auto& cell : cells) {
    cell.fault = fault_of(cell.group);
    try {
      if (cell.fault.empty())
        kept_.emplace(cell.cell,
                      writer_.add_cell(cell.result.key, cell.result.record, read_listed(cell.files, cell.file_hashes)));
    } catch (const ConfigError& e) {
      cell.fault = e.what();
    }
    use_again(std::move(cell.files));
  }
}

/// Removes the files of a folder and keeps it. A folder that cannot be emptied is removed, as far as possible.
void ArchiveSink::use_again(io::StagedFolder files) {
  std::error_code error;
  for (fs::directory_iterator entry(files.path(), error), end; !error && entry != end; entry.increment(error))
    if (!fs::remove_all(entry->path(), error) || error) return;
  if (!error) empty_folders_.push_back(files.release());
}

}  // namespace scanbench::runs
