// Decides which cells of an earlier run can be reused: by address, recording, then the bytes of every file.
#include "harness/runs/execute/resume.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/study/catalog/chain.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;

EarlierCells::EarlierCells(fs::path run) : run_(std::move(run)), hashes_(listed_hashes(run_)) {}

std::optional<EarlierCell> EarlierCells::find(const CellKey& key, const std::string& address,
                                              const study::PipelineSpec& pipeline, const study::TraceChoice& trace) {
  const fs::path folder = cell_path(run_, key);
  try {
    CellRecord record = load_status(folder);
    if (record.outcome.status != CellStatus::ok || record.address != address) return std::nullopt;
    const auto frames = recorded_frames(key.scenario, key.seed);
    if (!frames || !files_are_whole(key, pipeline, trace, *frames)) return std::nullopt;
    return EarlierCell{std::move(record), load_metrics(folder)};
  } catch (const ConfigError&) {
    return std::nullopt;  // absent or damaged: it is made again
  }
}

bool EarlierCells::is_ok(const CellKey& key) const {
  try {
    return load_status(cell_path(run_, key)).outcome.status == CellStatus::ok;
  } catch (const ConfigError&) {
    return false;
  }
}

std::optional<std::size_t> EarlierCells::recorded_frames(const std::string& scenario, std::uint64_t seed) {
  const auto [found, is_new] = recordings_.try_emplace({scenario, seed});
  if (!is_new) return found->second;
  try {
    const fs::path folder = recording_path(run_, scenario, seed);
    const std::size_t frames = load_recording(folder).observed.frames.size();
    if (hashes_agree(folder) != false) found->second = frames;
  } catch (const ConfigError&) {
    // Absent or damaged: it is made again.
  }
  return found->second;
}

bool EarlierCells::files_are_whole(const CellKey& key, const study::PipelineSpec& pipeline,
                                   const study::TraceChoice& trace, std::size_t frames) {
  const fs::path folder = cell_path(run_, key);
  const bool merge = study::has_slot(pipeline, "merge");
  const bool places = std::ranges::any_of(pipeline.slots, [](const auto& slot) { return slot.kind != "extract"; });
  for (const auto& [file, written] :
       {std::pair(&kTimingFile, true), std::pair(&kTraceFile, !trace.nothing()), std::pair(&kMergeFile, merge),
        std::pair(&kPoseMatchesFile, study::has_slot(pipeline, "match")),
        std::pair(&kMapFile, merge || study::has_slot(pipeline, "map")), std::pair(&kPosesFile, places && frames > 0)})
    if (written && !fs::exists(folder / *file)) return false;

  if (const auto agree = hashes_agree(folder)) return *agree;
  return load_result(folder).lines.size() == frames;
}

std::optional<bool> EarlierCells::hashes_agree(const fs::path& folder) {
  const std::string prefix = folder.lexically_relative(run_).generic_string() + "/";
  const auto first = hashes_.lower_bound(prefix);
  auto end = first;
  for (; end != hashes_.end() && end->first.starts_with(prefix); ++end)
    if (io::sha256_of_file(run_ / end->first) != end->second) return false;
  if (first == end) return std::nullopt;
  verified_.insert(first, end);
  return true;
}

}  // namespace scanbench::runs
