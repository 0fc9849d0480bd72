// Files and folders that appear complete or not at all: each is written under a temporary name beside its target,
// flushed to disk and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scanbench::io {

/// The bytes of a regular file (input_file.hpp) of at most half the machine's memory. Throws ConfigError with the
/// file's name and the reason.
std::string read_file(const std::filesystem::path& path);

/// Writes a complete file: after a failure (disk full, no permission) the target is unchanged and the temporary file is
/// removed. Throws ConfigError with the file's name and the reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for a file that must not exist yet. False, and nothing is changed, if it does.
bool write_new_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes a file inside a StagedFolder, which is flushed and renamed as a whole later. Throws ConfigError.
void write_staged_file(const std::filesystem::path& path, std::string_view bytes);

/// Removes a file. A file that does not exist is not an error. Throws ConfigError.
void remove_file(const std::filesystem::path& path);

/// Writes the entries of a folder to disk: the names of what was made or renamed in it. Throws SystemError.
void flush_folder(const std::filesystem::path& path);

/// Writes everything on the file system of a folder to disk. Throws SystemError.
void flush_file_system(const std::filesystem::path& folder);

/// Makes a folder and its parents. Throws ConfigError.
void make_folders(const std::filesystem::path& path);

/// Exchanges two existing folders of one file system, in one step if the file system supports it. Else in three: a
/// process that is killed between them may leave `b` under the name that put_back() looks for.
void exchange_folders(const std::filesystem::path& a, const std::filesystem::path& b);
/// The exchange in three steps.
void exchange_folders_in_steps(const std::filesystem::path& a, const std::filesystem::path& b);

/// If a killed exchange has left a folder aside, and at its place there is nothing or an empty folder, gives it its
/// name back and returns true. The folders that this finds aside are those of ended processes only if the caller
/// excludes others, for instance by a RunLock. Throws SystemError.
bool put_back(const std::filesystem::path& folder);

/// The folders that exchange_folders() has left aside of `folder`, sorted.
std::vector<std::filesystem::path> folders_aside(const std::filesystem::path& folder);

/// Removes the unfinished files and folders of killed processes inside a folder and below it, but for the paths `kept`
/// and what is below these. The caller excludes other writers.
void remove_temporaries(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& kept = {});

/// Removes the unfinished folders that killed processes have left beside a target, after put_back(). The caller
/// excludes other writers of the target.
void remove_unfinished_folders(const std::filesystem::path& target);

/// True for the names that StagedFolder and write_file_atomically give to unfinished files and folders.
bool is_temporary_name(std::string_view name);

/// 16 hexadecimal digits from the system's random numbers: a name that no other host or process chooses.
std::string unique_name();

/// A folder under construction beside its target: `.<name>.tmp-<pid>`. commit() flushes it and renames it to the
/// target; an earlier target is removed only after the new one is in place. Without commit() the new folder is removed.
class StagedFolder {
 public:
  explicit StagedFolder(std::filesystem::path target);
  /// Under construction at `staging`, a temporary name in the target's folder that nothing else uses.
  StagedFolder(std::filesystem::path target, std::filesystem::path staging);
  /// The same in a folder that exists and is empty.
  static StagedFolder in_empty_folder(std::filesystem::path target, std::filesystem::path staging);
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  ~StagedFolder();

  const std::filesystem::path& path() const { return staging_; }
  const std::filesystem::path& target() const { return target_; }
  /// Removes all files written so far, for instance by a worker that crashed.
  void clear();
  /// Gives the unfinished folder to the caller; returns its path.
  std::filesystem::path release() { return std::exchange(staging_, {}); }
  void commit();
  /// The two parts of commit(), for several folders of one file system, which a single flush() of any of them writes to
  /// disk. The caller flushes the folders that contain the targets. Both throw SystemError.
  void flush() const;
  void place();

 private:
  StagedFolder() = default;

  std::filesystem::path target_;
  std::filesystem::path staging_;
};

}  // namespace scanbench::io
