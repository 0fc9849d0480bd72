// What a shard leaves in the folder of its sweep: shards/<number>.<unique name>/, which appears whole or not at all. It
// has one archive with the files of all cells and recordings, and tables of what is in it.
//
// Nothing else is written there, so shards may run at the same time on several machines with a shared file system, and
// the same shard twice. No lock, database or process number is needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/store/cell_archive.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/cell_table.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::runs {

struct ShardCommit {
  std::filesystem::path folder;
  int shard = 0;
  std::string archive_sha256;
  CellTable table;

  std::filesystem::path archive() const { return folder / "cells.tar"; }
};

/// A commit under construction. Without commit() nothing remains.
class CommitWriter {
 public:
  /// Throws SystemError, as do the other functions; after that a cell or recording is not in the archive.
  CommitWriter(const std::filesystem::path& sweep, int number);

  /// Its unfinished folder, for files that are removed before commit().
  const std::filesystem::path& path() const { return staged_.path(); }
  /// Adds a recording, before its cells, unless it is there already.
  void add_recording(const std::string& scenario, std::uint64_t seed, const FolderFiles& files);
  /// Adds a cell. The size of its summary is not known yet.
  ArchivedCell add_cell(const CellKey& key, const CellRecord& record, const FolderFiles& files);
  bool has_recording(const std::string& scenario, std::uint64_t seed) const {
    return recordings_.contains({scenario, seed});
  }
  /// Writes the tables and puts the folder in place; returns it. `cells` have the sizes of their lines in `summary`, in
  /// its order.
  std::filesystem::path commit(const std::vector<ArchivedCell>& cells, const std::string& summary);

 private:
  struct Recording {
    ArchivedRecording archived;
    double scans = 0.0;
  };

  int number_;
  io::StagedFolder staged_;
  ArchiveWriter archive_;
  std::map<std::pair<std::string, std::uint64_t>, Recording> recordings_;
};

/// The committed shards of a sweep, in the order of their names.
struct ShardCommits {
  std::vector<ShardCommit> whole;
  std::vector<std::pair<std::string, std::string>> damaged;  ///< name of the folder, and what is wrong
  std::size_t unfinished = 0;                                ///< folders of shards that run or were killed
};
/// Reads their tables, not the archives. Of all shards, or of shard `number`.
ShardCommits load_commits(const std::filesystem::path& sweep, int number = 0);

/// Reads archives and compares their hashes.
class CommitCheck {
 public:
  /// True if every byte of the archive is as it was committed.
  bool is_whole(const ShardCommit& commit) { return archive_of(commit).is_whole; }
  /// True if the files of the cell and of its recording are as they were committed.
  bool is_whole(const ShardCommit& commit, const ArchivedCell& cell);
  bool is_whole(const ShardCommit& commit, const std::string& scenario, std::uint64_t seed);

 private:
  struct Archive {
    bool is_whole = false;                ///< every byte is as it was written
    std::optional<ArchiveReader> reader;  ///< none: the file does not exist
    std::map<std::uint64_t, bool> recordings;
  };
  Archive& archive_of(const ShardCommit& commit);

  std::map<std::string, Archive> archives_;  ///< by folder; those that have been read
};

/// Addresses of the cells that are committed with undamaged files, by all shards or by shard `number`.
std::unordered_set<std::string> committed_addresses(const std::filesystem::path& sweep, int number = 0);

/// The first file whose repeatable part differs between two folders, like "lines.csv".
std::string differing_file(const FolderFiles& a, const FolderFiles& b);

}  // namespace scanbench::runs
