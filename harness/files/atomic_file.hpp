// Files and folders that appear complete or not at all: each is written under a temporary name beside its target,
// flushed to disk and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace scanbench::harness {

/// The bytes of a regular file (input_file.hpp) of at most half the machine's memory. Throws ConfigError with the
/// file's name and the reason.
std::string read_file(const std::filesystem::path& path);

/// Writes a complete file: after a failure (disk full, no permission) the target is unchanged and the temporary file is
/// removed. Throws ConfigError with the file's name and the reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Writes a file inside a StagedFolder, flushed later, in place of a file, link, pipe or folder. Throws ConfigError.
void write_staged_file(const std::filesystem::path& path, std::string_view bytes);

/// Removes a file. A file that does not exist is no error. Throws ConfigError.
void remove_file(const std::filesystem::path& path);

/// Writes the entries of a folder to disk: the names of what was made or renamed in it. Throws SystemError.
void flush_folder(const std::filesystem::path& path);

/// Writes everything on the file system of a folder to disk. Throws SystemError.
void flush_file_system(const std::filesystem::path& folder);

/// Makes a folder and its parents. Throws ConfigError.
void make_folders(const std::filesystem::path& path);

/// Exchanges two existing folders of one file system, in one step if the file system supports it.
void exchange_folders(const std::filesystem::path& a, const std::filesystem::path& b);

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

}  // namespace scanbench::harness
