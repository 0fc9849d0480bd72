// Trust after a look: address, recording, then the bytes of every file.
#include "harness/resume.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "harness/hash.hpp"
#include "harness/pipeline.hpp"
#include "harness/recording_folder.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

StandingCells::StandingCells(fs::path run) : run_(std::move(run)), hashes_(listed_hashes(run_)) {}

std::optional<StandingCell> StandingCells::find(const CellKey& key, const std::string& address,
                                                const PipelineSpec& pipeline, const TraceChoice& trace) {
  const fs::path folder = cell_path(run_, key);
  try {
    CellRecord record = load_status(folder);
    if (record.outcome.status != CellStatus::ok || record.address != address) return std::nullopt;
    const auto frames = recorded_frames(key.scenario, key.seed);
    if (!frames || !files_stand(key, pipeline, trace, *frames)) return std::nullopt;
    return StandingCell{std::move(record), load_metrics(folder)};
  } catch (const ConfigError&) {
    return std::nullopt;  // absent or damaged: it is made again
  }
}

std::optional<std::size_t> StandingCells::recorded_frames(const std::string& scenario, std::uint64_t seed) {
  const auto [found, is_new] = recordings_.try_emplace({scenario, seed});
  if (!is_new) return found->second;
  try {
    found->second = load_recording(recording_path(run_, scenario, seed)).observed.frames.size();
  } catch (const ConfigError&) {
    // Absent or damaged: it is made again.
  }
  return found->second;
}

bool StandingCells::files_stand(const CellKey& key, const PipelineSpec& pipeline, const TraceChoice& trace,
                                std::size_t frames) const {
  const fs::path folder = cell_path(run_, key);
  const bool merge = has_slot(pipeline, "merge");
  const bool places = std::ranges::any_of(pipeline.slots, [](const auto& slot) { return slot.kind != "extract"; });
  for (const auto& [file, written] :
       {std::pair("timing.csv", true), std::pair("trace.csv", !trace.nothing()), std::pair("merge_labels.csv", merge),
        std::pair("pose_matches.csv", has_slot(pipeline, "match")),
        std::pair("map.csv", merge || has_slot(pipeline, "map")), std::pair("poses.csv", places && frames > 0)})
    if (written && !fs::exists(folder / file)) return false;

  const std::string prefix = folder.lexically_relative(run_).generic_string() + "/";
  bool listed = false;
  for (auto file = hashes_.lower_bound(prefix); file != hashes_.end() && file->first.starts_with(prefix); ++file) {
    if (sha256_of_file(run_ / file->first) != file->second) return false;
    listed = true;
  }
  return listed || load_result(folder).lines.size() == frames;
}

}  // namespace scanbench::harness
