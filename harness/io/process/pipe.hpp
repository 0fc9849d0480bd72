// Pipes, and a reader that does not block and keeps the last bytes.
#pragma once

#include <cstddef>
#include <string>

#include "harness/io/files/descriptor.hpp"

namespace scanbench::io {

struct Pipe {
  FileDescriptor read_end, write_end;
};

/// A pipe that programs do not inherit. Throws std::system_error.
Pipe make_pipe();

inline constexpr std::size_t kOutputKept = 4096;  ///< bytes kept of what a process prints, at least

/// The read end of a pipe and what came through it. A process may write without end: at least the last `kept` bytes
/// are kept, and at most twice as many and what one call of drain() takes.
class PipeReader {
 public:
  PipeReader() = default;  ///< of no pipe: empty
  PipeReader(FileDescriptor read_end, std::size_t kept);

  /// Takes the available bytes, at most 1 MiB, so that other pipes get their turn. At the end of the pipe it is closed.
  void drain();
  void close() { read_end_.close(); }
  bool is_open() const { return read_end_.is_open(); }
  int descriptor() const { return read_end_.number(); }  ///< for ppoll(); -1 if it is closed
  std::string& bytes() { return bytes_; }
  const std::string& bytes() const { return bytes_; }

 private:
  FileDescriptor read_end_;
  std::size_t kept_ = 0;
  std::string bytes_;
};

}  // namespace scanbench::io
