// Flushes finished folders to disk, renames them and flushes the folders that contain them.
#include "harness/runs/execute/folder_sink.hpp"

#include <set>
#include <utility>

#include "core/error.hpp"
#include "harness/runs/store/recording_folder.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using SinkClock = std::chrono::steady_clock;

/// Of the time, the part that is spent on flushing the disk: one in this many.
constexpr int kFlushShare = 20;

/// A new recording replaces the old one only if it differs.
bool is_in_place(const FinishedRecording& recording) {
  const fs::path& old = recording.files.target();
  try {
    return fs::exists(old) && recording_hash(load_recording(old)) == recording.content_hash;
  } catch (const ConfigError&) {
    return false;  // the old recording is damaged
  }
}

/// Writes all files to disk: they are on one file system.
void flush_disk(const std::vector<FinishedRecording>& recordings, const std::vector<FinishedCell>& cells) {
  if (!cells.empty())
    cells.front().files.flush();
  else if (!recordings.empty())
    recordings.front().files.flush();
}

}  // namespace

FolderSink::FolderSink(fs::path run, WrittenHashes& written) : run_(std::move(run)), written_(written) {}

std::string FolderSink::hashes_of(const fs::path& folder) const {
  return io::hash_lines(folder);
}

io::StagedFolder FolderSink::stage(const fs::path& place) {
  return io::StagedFolder(run_ / place);
}

bool FolderSink::is_due() const {
  return SinkClock::now() >= due_;
}

void FolderSink::keep(std::vector<FinishedRecording> recordings, std::vector<FinishedCell>& cells) {
  const auto begun = SinkClock::now();
  try {
    flush_disk(recordings, cells);
    place_all(recordings, cells);
  } catch (const ConfigError& e) {
    for (const auto& recording : recordings) lose_recording(recording.group, e.what());
    for (auto& cell : cells) cell.fault = e.what();
  }
  const auto ended = SinkClock::now();
  due_ = ended + kFlushShare * (ended - begun);
}

/// Renames recordings, then cells. Throws ConfigError if the new names cannot be written to disk.
void FolderSink::place_all(std::vector<FinishedRecording>& recordings, std::vector<FinishedCell>& cells) {
  std::set<fs::path> parents;
  for (auto& recording : recordings) {
    if (is_in_place(recording)) continue;
    try {
      place(recording.files, recording.file_hashes);
      parents.insert(recording.files.target().parent_path());
    } catch (const ConfigError& e) {
      lose_recording(recording.group, e.what());
    }
  }
  for (auto& cell : cells) {
    cell.fault = fault_of(cell.group);
    if (!cell.fault.empty()) continue;
    try {
      place(cell.files, cell.file_hashes);
      parents.insert(cell.files.target().parent_path());
    } catch (const ConfigError& e) {
      cell.fault = e.what();
    }
  }
  for (const auto& parent : parents) io::flush_folder(parent);
}

void FolderSink::place(io::StagedFolder& files, const std::string& hashes) {
  files.place();
  written_.add(files.target().lexically_relative(run_), hashes);
}

}  // namespace scanbench::runs
