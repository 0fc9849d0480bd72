// Converts labels of timing.csv to slot and stage, and back.
#include "core/trace/stage_time.hpp"

#include <algorithm>
#include <array>

#include "core/modules.hpp"

namespace scanbench {
namespace {

constexpr std::array kSlots{LineExtractor::kKind, Aligner::kKind, ScanMatcher::kKind, Mapper::kKind,
                            SegmentMerger::kKind};

}  // namespace

std::string StageTime::label() const {
  if (!stage) return slot;
  const std::string name(to_string(*stage));
  return of_extraction() ? name : slot + "." + name;
}

std::optional<StageTime> stage_time_labelled(std::string_view label, int frame) {
  StageTime time{.stage = std::nullopt, .frame = frame};
  const std::size_t dot = label.find('.');
  const std::string_view slot = label.substr(0, dot);
  const bool is_slot = std::ranges::find(kSlots, slot) != kSlots.end();
  // Mergers work on whole recordings: `merge` on a frame is a stage of the slot `extract`.
  const bool stage_of_extract = !is_slot || (label == SegmentMerger::kKind && frame >= 0);
  if (!stage_of_extract) time.slot = slot;
  if (is_slot && dot == std::string_view::npos && !stage_of_extract) return time;
  time.stage = stage_named(stage_of_extract ? label : label.substr(std::min(slot.size() + 1, label.size())));
  if (!time.stage) return std::nullopt;
  return time;
}

}  // namespace scanbench
