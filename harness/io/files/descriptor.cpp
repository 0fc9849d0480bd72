// Closes descriptors and writes to them.
#include "harness/io/files/descriptor.hpp"

#include <unistd.h>

#include <cerrno>

namespace scanbench::io {

int FileDescriptor::close() {
  return is_open() ? ::close(std::exchange(number_, -1)) : 0;
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace scanbench::io
