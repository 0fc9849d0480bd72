// Locks a run folder with flock() on the folder itself, so that no lock file can remain.
#include "harness/runs/store/run_lock.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"

namespace scanbench::runs {
namespace {

/// False if the path now names another folder, because a run has just replaced its predecessor.
bool is_still_at(int descriptor, const std::filesystem::path& folder) {
  struct stat opened {
  }, found{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(folder.c_str(), &found) == 0 && opened.st_dev == found.st_dev &&
         opened.st_ino == found.st_ino;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) {
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) throw ConfigError("cannot read " + folder.string() + ": " + std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw ConfigError("another run is writing to " + folder.string());
    }
  } while (!is_still_at(descriptor_, folder));
}

RunLock::~RunLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

RunLock::RunLock(RunLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

RunLock& RunLock::operator=(RunLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace scanbench::runs
