// Keeps the recordings and cells of a shard in the archive that it commits.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/runs/execute/cell_sink.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/sweep/shard_commit.hpp"

namespace scanbench::runs {

/// A few folders are used again and again, because removing one takes milliseconds on some file systems.
class ArchiveSink : public CellSink {
 public:
  /// Throws SystemError. `plan` must remain.
  ArchiveSink(const RunPlan& plan, const std::filesystem::path& sweep, int shard);

  const std::filesystem::path& root() const override { return sweep_; }
  std::string hashes_of(const std::filesystem::path& folder) const override;
  /// A cell that was kept; it is taken out.
  ArchivedCell take_cell(std::size_t cell);
  /// As CommitWriter::commit(); no child may write any more.
  std::filesystem::path commit(const std::vector<ArchivedCell>& cells, const std::string& summary);

 private:
  io::StagedFolder stage(const std::filesystem::path& place) override;
  bool is_due() const override { return true; }
  void keep(std::vector<FinishedRecording> recordings, std::vector<FinishedCell>& cells) override;
  void use_again(io::StagedFolder files);

  const RunPlan& plan_;
  std::filesystem::path sweep_;
  CommitWriter writer_;
  std::map<std::size_t, ArchivedCell> kept_;          ///< by index into RunPlan::cells
  std::vector<std::filesystem::path> empty_folders_;  ///< to be used again
  std::size_t folders_made_ = 0;
};

}  // namespace scanbench::runs
