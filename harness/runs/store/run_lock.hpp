// The lock of a run folder, taken by everything that writes into it.
#pragma once

#include <filesystem>

namespace scanbench::runs {

/// Exclusive while it exists; the system releases it when the process ends, even after a crash.
class RunLock {
 public:
  /// Throws ConfigError if another process holds it, or the folder cannot be read.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&& other) noexcept;
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace scanbench::runs
