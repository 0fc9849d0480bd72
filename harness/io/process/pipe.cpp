// Makes pipes, and drains them block by block.
#include "harness/io/process/pipe.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace scanbench::io {
namespace {

constexpr std::size_t kBlock = 1 << 14;
constexpr int kBlocksAtOnce = 64;

}  // namespace

Pipe make_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

PipeReader::PipeReader(FileDescriptor read_end, std::size_t kept) : read_end_(std::move(read_end)), kept_(kept) {
  ::fcntl(descriptor(), F_SETFL, O_NONBLOCK);
}

void PipeReader::drain() {
  if (!is_open()) return;
  std::array<char, kBlock> block{};
  for (int i = 0; i < kBlocksAtOnce; ++i) {
    const ssize_t n = ::read(descriptor(), block.data(), block.size());
    if (n > 0) {
      bytes_.append(block.data(), static_cast<std::size_t>(n));
    } else if (n == 0 || errno != EINTR) {
      if (n == 0 || errno != EAGAIN) close();
      break;
    }
  }
  if (bytes_.size() > 2 * kept_) bytes_.erase(0, bytes_.size() - kept_);
}

}  // namespace scanbench::io
