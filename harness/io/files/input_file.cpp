// Opens files without blocking and checks their type before the first read.
#include "harness/io/files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "harness/io/files/size_text.hpp"

namespace scanbench::io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& verb, int error) {
  throw ConfigError(path.string() + ": " + verb + ": " + std::strerror(error));
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  struct stat info {};
  if (::stat(path_.c_str(), &info) != 0) {
    if (errno == ENOENT) throw ConfigError(path_.string() + ": no such file");
    refuse(path_, "cannot be opened", errno);
  }
  // Checked before and after open(): opening some devices has side effects, and the name may change in between.
  const auto check_type = [&] {
    if (!S_ISREG(info.st_mode)) throw ConfigError(path_.string() + ": not a regular file; allowed: a file on disk");
  };
  check_type();
  fd_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) refuse(path_, "cannot be opened", errno);
  try {
    if (::fstat(fd_, &info) != 0) refuse(path_, "cannot be opened", errno);
    check_type();
  } catch (...) {
    ::close(fd_);
    throw;
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
}

InputFile::~InputFile() {
  ::close(fd_);
}

void InputFile::require_at_most(std::uint64_t max_bytes) const {
  if (size_ > max_bytes)
    throw ConfigError(path_.string() + ": larger than " + size_text(static_cast<double>(max_bytes)) + " (" +
                      size_text(static_cast<double>(size_)) + ")");
}

std::size_t InputFile::read(std::span<char> block) {
  while (true) {
    const ssize_t n = ::read(fd_, block.data(), block.size());
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EINTR) refuse(path_, "cannot be read", errno);
  }
}

std::size_t InputFile::read_at(std::uint64_t offset, std::span<char> block) const {
  std::size_t filled = 0;
  while (filled < block.size()) {
    const ssize_t n = ::pread(fd_, block.data() + filled, block.size() - filled, static_cast<off_t>(offset + filled));
    if (n == 0) break;
    if (n < 0 && errno != EINTR) refuse(path_, "cannot be read", errno);
    if (n > 0) filled += static_cast<std::size_t>(n);
  }
  return filled;
}

int InputFile::duplicate() const {
  const int copy = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) refuse(path_, "cannot be opened", errno);
  return copy;
}

}  // namespace scanbench::io
