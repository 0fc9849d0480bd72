// The folder of a run: where things are in it, and how a new run takes the place of an old one.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/atomic_file.hpp"

namespace scanbench::harness {

struct CellKey {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  auto operator<=>(const CellKey&) const = default;
};
std::string to_string(const CellKey& key);  ///< "scenario/pipeline/seed"

std::filesystem::path cell_path(const std::filesystem::path& run, const CellKey& key);
std::filesystem::path recording_path(const std::filesystem::path& run, const std::string& scenario, std::uint64_t seed);

/// Throws ConfigError unless the name can be a folder's name on its own: not empty, no '/', no leading '.'.
void check_name(const std::string& what, const std::string& name);

/// True for the paths, relative to the run folder, that a run, its figures and its reports write.
bool is_run_file(const std::filesystem::path& relative);

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
