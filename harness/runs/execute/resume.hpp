// The cells of an earlier run that can be reused: made from the same input by the same program, with undamaged files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/study/scenario/trace_choice.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {

struct EarlierCell {
  CellRecord record;
  std::vector<metrics::MetricRow> metrics;
};

class EarlierCells {
 public:
  /// Reads the run's list of hashes (listed_hashes()). Construct it before the manifest is rewritten.
  explicit EarlierCells(std::filesystem::path run);

  /// Returns the cell if it is ok, has this address, and its recording is undamaged. All listed files must have their
  /// SHA-256. If a killed run has left no list, the files that the pipeline writes must exist, be readable, and agree
  /// with each other and with the recording.
  std::optional<EarlierCell> find(const CellKey& key, const std::string& address, const study::PipelineSpec& pipeline,
                                  const study::TraceChoice& trace);

  /// True if the cell is ok, with any input and program.
  bool is_ok(const CellKey& key) const;

  /// By path: the hashes of all files that find() has read and found undamaged.
  const std::map<std::string, std::string>& verified() const { return verified_; }

 private:
  /// Number of frames; nullopt if the recording is missing or does not have its hash.
  std::optional<std::size_t> recorded_frames(const std::string& scenario, std::uint64_t seed);
  /// True if all files of the folder have the listed hashes; nullopt if none is listed. Throws ConfigError for a file
  /// that cannot be read.
  std::optional<bool> hashes_agree(const std::filesystem::path& folder);
  /// Throws ConfigError for a file that cannot be read.
  bool files_are_whole(const CellKey& key, const study::PipelineSpec& pipeline, const study::TraceChoice& trace,
                       std::size_t frames);

  std::filesystem::path run_;
  std::map<std::string, std::string> hashes_;  ///< by path relative to the run
  std::map<std::string, std::string> verified_;
  std::map<std::pair<std::string, std::uint64_t>, std::optional<std::size_t>> recordings_;
};

}  // namespace scanbench::runs
