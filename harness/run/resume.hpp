// The cells of an earlier run that can be reused: made of the same input by the same program, with whole files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/scenario/trace_choice.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/run_folder.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

struct EarlierCell {
  CellRecord record;
  std::vector<metrics::MetricRow> metrics;
};

class EarlierCells {
 public:
  /// Reads the hashes in the run's manifest: must be constructed before that is written anew.
  explicit EarlierCells(std::filesystem::path run);

  /// The cell, if it is ok, has this address, and the recording of its scenario and seed is whole. All files that the
  /// manifest lists must have their SHA-256; where a killed run has left no list, those that the pipeline writes must
  /// be there, readable, and fit each other and the recording.
  std::optional<EarlierCell> find(const CellKey& key, const std::string& address, const PipelineSpec& pipeline,
                                  const TraceChoice& trace);

  /// True if the cell has ended well, whatever it was made of.
  bool is_ok(const CellKey& key) const;

 private:
  /// Number of frames; none if the recording is absent or not what its hash says.
  std::optional<std::size_t> recorded_frames(const std::string& scenario, std::uint64_t seed);
  /// Have all files of the folder the hashes that the manifest lists? Nothing if it lists none of them. Throws
  /// ConfigError for a file that cannot be read.
  std::optional<bool> hashes_agree(const std::filesystem::path& folder) const;
  /// Throws ConfigError for a file that cannot be read.
  bool files_are_whole(const CellKey& key, const PipelineSpec& pipeline, const TraceChoice& trace,
                       std::size_t frames) const;

  std::filesystem::path run_;
  std::map<std::string, std::string> hashes_;  ///< by path relative to the run
  std::map<std::pair<std::string, std::uint64_t>, std::optional<std::size_t>> recordings_;
};

}  // namespace scanbench::harness
