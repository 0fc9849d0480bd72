// How a new run takes the place of an old one.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/files/atomic_file.hpp"

namespace scanbench::harness {

/// Where a run is written.
///
/// - The folder does not exist or is empty: written in place, and an interrupted run stays there to be resumed.
/// - It is a run and is to be resumed: written in place.
/// - It is a run and is not to be resumed: the new run grows in a temporary folder beside it and takes its place when
///   it has ended; interrupted, it vanishes and the old one stays as it was. Files in the old folder that no run writes
///   move along into the new one.
/// - Anything else is somebody else's: ConfigError.
///
/// Two runs at once in one folder are refused.
class RunTarget {
 public:
  RunTarget(std::filesystem::path out, bool resume);
  ~RunTarget();
  RunTarget(const RunTarget&) = delete;
  RunTarget& operator=(const RunTarget&) = delete;

  const std::filesystem::path& path() const { return staged_ ? staged_->path() : out_; }
  bool resumed() const { return resumed_; }
  /// The run takes its place.
  void finish();
  /// The run could not begin: what it has written is removed.
  void abandon();

 private:
  std::filesystem::path out_;
  std::optional<StagedFolder> staged_;
  std::filesystem::path first_made_;  ///< topmost folder that was not there before; may be empty
  bool resumed_ = false;
  int lock_ = -1;
};

}  // namespace scanbench::harness
