// Owned file descriptors.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace scanbench::io {

/// Closes a file descriptor at the end of its life.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }  ///< -1 if there is none, which ppoll() ignores
  bool is_open() const { return number_ >= 0; }
  /// Returns 0, or -1 with errno: a network file system may report a failed write only here. May be repeated.
  int close();

 private:
  int number_ = -1;
};

/// Writes all bytes to a descriptor that blocks. False, with errno, if it takes no more.
bool write_all(int descriptor, std::span<const std::byte> bytes);

}  // namespace scanbench::io
