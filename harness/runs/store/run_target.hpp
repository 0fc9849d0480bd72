// Replacement of an old run by a new one.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/store/run_lock.hpp"

namespace scanbench::runs {

/// The folder into which a run is written.
///
/// - If the folder does not exist, or has only temporary files of a killed run, the run is written in place. An
///   interrupted run stays there and can be resumed.
/// - If it has a run that is resumed, the run is written in place.
/// - If it has a run that is not resumed, the new run is written to a temporary folder beside it and replaces it in
///   finish(). Without finish() the new run is removed and the old one is unchanged. Files in the old folder that no
///   run writes are kept in the new one. If one of them cannot be kept, ConfigError is thrown before anything runs.
/// - Any other folder is refused: ConfigError.
///
/// The folder is locked while the target exists, before and after the replacement.
class RunTarget {
 public:
  RunTarget(std::filesystem::path out, bool resume);
  RunTarget(const RunTarget&) = delete;
  RunTarget& operator=(const RunTarget&) = delete;
  ~RunTarget() = default;

  const std::filesystem::path& path() const { return staged_ ? staged_->path() : out_; }
  bool resumed() const { return resumed_; }
  /// True while an old run exists that finish() would replace.
  bool replaces() const { return staged_.has_value(); }
  /// Replaces the old run, if there is one.
  void finish();
  /// Removes everything written so far, for a run that could not begin.
  void abandon();

 private:
  std::filesystem::path out_;
  std::optional<io::StagedFolder> staged_;
  std::filesystem::path first_made_;  ///< topmost folder that this run made; may be empty
  bool resumed_ = false;
  std::optional<RunLock> lock_;         ///< of the folder
  std::optional<RunLock> staged_lock_;  ///< of the one that replaces it
};

}  // namespace scanbench::runs
