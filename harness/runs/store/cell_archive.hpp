// An archive with the folders of many cells and recordings: a tar file that is written once, from its beginning to its
// end. Tables beside it say which part of it a folder is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "harness/io/files/hash.hpp"
#include "harness/io/files/hash_list.hpp"
#include "harness/io/files/input_file.hpp"

namespace scanbench::runs {

/// Bytes of a cell or a recording in an archive: they are held in memory, several times.
inline constexpr std::uint64_t kLargestFolder = std::uint64_t{2} << 30;

/// The bytes of a folder's files, by name.
using FolderFiles = std::map<std::string, std::string>;
/// The files of a folder that `listed` names with their SHA-256; what else is there is not looked at. Throws
/// ConfigError for a file that is missing or has changed, and, before anything is read, for more than `most` bytes
/// together.
FolderFiles read_files(const std::filesystem::path& folder, const io::FileHashes& listed,
                       std::uint64_t most = kLargestFolder);
/// All files of a folder, which has no more than `most` bytes.
FolderFiles read_folder(const std::filesystem::path& folder, std::uint64_t most = kLargestFolder);

/// The bytes of an archive that hold one folder.
struct ArchivePart {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::string sha256;
};

class ArchiveWriter {
 public:
  /// Makes the file. Throws SystemError, as do the other functions.
  explicit ArchiveWriter(std::filesystem::path file);
  ~ArchiveWriter();
  ArchiveWriter(const ArchiveWriter&) = delete;
  ArchiveWriter& operator=(const ArchiveWriter&) = delete;

  /// Appends the files of a folder, "cells/room/iepf/7". After a failure the archive is what it was before.
  ArchivePart add(const std::filesystem::path& folder, const FolderFiles& files);
  /// Writes the end; returns the SHA-256 of the archive.
  std::string finish();

 private:
  void append(std::span<const char> bytes);

  std::filesystem::path file_;
  int descriptor_;
  std::uint64_t end_ = 0;
  io::Sha256 hash_;
};

class ArchiveReader {
 public:
  /// Throws ConfigError if there is no such file.
  explicit ArchiveReader(const std::filesystem::path& file) : file_(file) {}

  /// True if these bytes exist and have their hash.
  bool is_whole(const ArchivePart& part) const;
  /// The files of a folder that was added under this name. Throws ConfigError if the part is cut off or changed.
  FolderFiles files(const ArchivePart& part, const std::filesystem::path& folder) const;

 private:
  std::string read(const ArchivePart& part) const;

  io::InputFile file_;
};

}  // namespace scanbench::runs
