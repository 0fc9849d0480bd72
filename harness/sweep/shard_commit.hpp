// What a shard leaves in the folder of its sweep: shards/<number>.<unique name>/, which appears whole or not at all.
//
// Nothing else is written there, so shards may run at the same time on several machines with a shared file system, and
// the same shard twice. No lock, database or process number is needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/files/atomic_file.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/run_folder.hpp"

namespace scanbench::harness {

/// Hashes of the files in the folder of a cell or recording.
struct FolderHashes {
  std::map<std::string, std::string> files;  ///< SHA-256 by name
  std::string whole;                         ///< of all names and hashes
  /// Of what must be equal each time the cell is made: not timing.csv, the times and memory in status.json, and the
  /// metrics t_*.
  std::string result;
};
FolderHashes hash_folder(const std::filesystem::path& folder);

struct CommittedCell {
  CellKey key;
  std::string address;
  CellStatus status = CellStatus::failed;
  std::string whole;   ///< FolderHashes::whole
  std::string result;  ///< FolderHashes::result
  std::size_t summary_begin = 0;
  std::size_t summary_size = 0;  ///< of its lines in the summary.csv of the shard
};

struct CommittedRecording {
  std::string scenario;
  std::uint64_t seed = 0;
  std::string whole;
};

struct ShardCommit {
  std::filesystem::path folder;
  int shard = 0;
  std::vector<CommittedCell> cells;
  std::vector<CommittedRecording> recordings;
};

/// Where shard `number` is made before it is committed. The name is unique.
StagedFolder stage_shard(const std::filesystem::path& sweep, int number);

/// Writes the tables of the commit into the staged folder, which has the cells, their recordings and the summary, and
/// puts it in place. `cells` need key, address, status and summary. Throws SystemError.
void commit_shard(StagedFolder& staged, int number, std::vector<CommittedCell> cells, const std::string& summary);

/// The committed shards of a sweep, in the order of their names.
struct ShardCommits {
  std::vector<ShardCommit> whole;
  std::vector<std::pair<std::string, std::string>> damaged;  ///< name of the folder, and what is wrong
  std::size_t unfinished = 0;                                ///< folders of shards that run or were killed
};
/// Reads their tables, not the files of cells. Of all shards, or of shard `number`.
ShardCommits load_commits(const std::filesystem::path& sweep, int number = 0);

/// Reads the files of commits and compares their hashes.
class CommitCheck {
 public:
  /// True if the files of the cell and of its recording are as they were committed; `hashes` gets those of the cell.
  bool is_whole(const ShardCommit& commit, const CommittedCell& cell, FolderHashes* hashes = nullptr);
  /// The hashes of a recording; null if it is damaged.
  const FolderHashes* recording(const ShardCommit& commit, const std::string& scenario, std::uint64_t seed);

 private:
  std::map<std::string, FolderHashes> recordings_;  ///< by path; those that have been read
};

}  // namespace scanbench::harness
