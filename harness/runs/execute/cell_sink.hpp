// Where an execution keeps the files of recordings and cells: folders of a run (folder_sink.hpp), or the archive of a
// shard.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/run_options.hpp"

namespace scanbench::runs {

struct FinishedRecording {
  std::size_t group = 0;     ///< index into RunPlan::groups
  std::string content_hash;  ///< recording_hash()
  std::string file_hashes;   ///< what CellSink::hashes_of() returned
  io::StagedFolder files;
};

struct FinishedCell {
  std::size_t cell = 0;   ///< index into RunPlan::cells
  std::size_t group = 0;  ///< index into RunPlan::groups
  CellResult result;
  std::string summary;  ///< its lines of summary.csv
  std::string file_hashes;
  io::StagedFolder files;  ///< of a cell that is not ok, only status.json
  std::string fault = {};  ///< set by flush(): why it could not be kept; empty: it was
};

/// Recordings and cells are put one by one and kept together, when they are flushed. A recording is put before its
/// cells.
class CellSink {
 public:
  CellSink() = default;
  CellSink(const CellSink&) = delete;
  CellSink& operator=(const CellSink&) = delete;
  virtual ~CellSink() = default;

  /// Makes an empty folder, in which a child writes the files of the group's recording or of a cell. `place` is their
  /// path in a run. Throws ConfigError, also if the recording of the group could not be kept.
  io::StagedFolder begin(std::size_t group, const std::filesystem::path& place);
  /// The folder of the run or the sweep, in which all that it begins is.
  virtual const std::filesystem::path& root() const = 0;
  /// What the sink must know of written files. The child that has written them computes it.
  virtual std::string hashes_of(const std::filesystem::path& folder) const;
  void put(FinishedRecording recording);
  void put(FinishedCell cell);
  /// Keeps what was put; returns these cells.
  std::vector<FinishedCell> flush();
  /// The same if there are cells and their turn has come.
  std::vector<FinishedCell> flush_if_due();

 protected:
  /// Notes why a recording could not be kept: then its cells cannot be kept either.
  void lose_recording(std::size_t group, const std::string& fault) { faults_[group] = fault; }
  /// Empty if nothing is wrong with the group's recording.
  std::string fault_of(std::size_t group) const;

 private:
  virtual io::StagedFolder stage(const std::filesystem::path& place) = 0;
  virtual bool is_due() const = 0;
  /// Sets the faults of cells, and calls lose_recording().
  virtual void keep(std::vector<FinishedRecording> recordings, std::vector<FinishedCell>& cells) = 0;

  std::vector<FinishedRecording> recordings_;
  std::vector<FinishedCell> cells_;
  std::map<std::size_t, std::string> faults_;  ///< by group
};

}  // namespace scanbench::runs
