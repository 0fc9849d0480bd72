// Guarded access to input files: only regular files are read, so that no FIFO, device or folder can block or flood a
// read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace scanbench::io {

/// A regular file, open for reading.
class InputFile {
 public:
  /// Throws ConfigError for a missing or unreadable file, and for a path that is not a regular file.
  explicit InputFile(std::filesystem::path path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  const std::filesystem::path& path() const { return path_; }
  /// Bytes on disk when it was opened; 0 for files in /proc.
  std::uint64_t size() const { return size_; }
  /// Throws ConfigError if the file is larger than this.
  void require_at_most(std::uint64_t max_bytes) const;
  /// Reads the next bytes into the block and returns their number: 0 at the end. Throws ConfigError.
  std::size_t read(std::span<char> block);
  /// Fills the block with the bytes from `offset` on; returns their number, which is smaller only at the end of the
  /// file. Throws ConfigError.
  std::size_t read_at(std::uint64_t offset, std::span<char> block) const;
  /// A second descriptor of the open file, which the caller closes. Throws ConfigError.
  int duplicate() const;

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace scanbench::io
