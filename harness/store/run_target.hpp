// How a new run replaces an old one.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/files/atomic_file.hpp"
#include "harness/store/run_lock.hpp"

namespace scanbench::harness {

/// Where a run is written.
///
/// - The folder does not exist, or holds nothing but temporary files of a killed run: written in place, and an
///   interrupted run stays there to be resumed.
/// - It is a run and is to be resumed: written in place.
/// - It is a run and is not to be resumed: the new run grows in a temporary folder beside it and replaces it in
///   finish(); without finish() the new one is removed and the old one stays as it was. Files in the old folder that no
///   run writes are taken over into the new one; ConfigError, before anything runs, if one of them cannot be.
/// - Any other folder is refused: ConfigError.
///
/// The folder is locked while the target exists, before and after the replacement.
class RunTarget {
 public:
  RunTarget(std::filesystem::path out, bool resume);
  RunTarget(const RunTarget&) = delete;
  RunTarget& operator=(const RunTarget&) = delete;

  const std::filesystem::path& path() const { return staged_ ? staged_->path() : out_; }
  bool resumed() const { return resumed_; }
  /// True while an old run exists that finish() would replace.
  bool replaces() const { return staged_.has_value(); }
  /// Replaces the old run, if there is one.
  void finish();
  /// The run could not begin: what it has written is removed.
  void abandon();

 private:
  std::filesystem::path out_;
  std::optional<StagedFolder> staged_;
  std::filesystem::path first_made_;  ///< topmost folder that was not there before; may be empty
  bool resumed_ = false;
  std::optional<RunLock> lock_;         ///< of the folder
  std::optional<RunLock> staged_lock_;  ///< of the one that replaces it
};

}  // namespace scanbench::harness
