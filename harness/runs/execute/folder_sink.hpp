// Keeps recordings and cells as folders of a run.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/runs/execute/cell_sink.hpp"
#include "harness/runs/store/written_hashes.hpp"

namespace scanbench::runs {

/// Folders are put in place together, as often as a twentieth of the time allows, because each flush of the disk takes
/// milliseconds.
class FolderSink : public CellSink {
 public:
  /// `written` gets the hashes of all files that are put in place.
  FolderSink(std::filesystem::path run, WrittenHashes& written);

  const std::filesystem::path& root() const override { return run_; }
  std::string hashes_of(const std::filesystem::path& folder) const override;

 private:
  io::StagedFolder stage(const std::filesystem::path& place) override;
  bool is_due() const override;
  void keep(std::vector<FinishedRecording> recordings, std::vector<FinishedCell>& cells) override;
  void place_all(std::vector<FinishedRecording>& recordings, std::vector<FinishedCell>& cells);
  void place(io::StagedFolder& files, const std::string& hashes);

  std::filesystem::path run_;
  WrittenHashes& written_;
  std::chrono::steady_clock::time_point due_{};
};

}  // namespace scanbench::runs
