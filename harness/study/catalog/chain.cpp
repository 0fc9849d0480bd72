// The table of slots, and the check of a pipeline against it.
#include "harness/study/catalog/chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/modules.hpp"

namespace scanbench::study {
namespace {

constexpr std::array kSlots = {SlotKind{LineExtractor::kKind, 0}, SlotKind{Aligner::kKind, 1},
                               SlotKind{ScanMatcher::kKind, 1}, SlotKind{Mapper::kKind, 2},
                               SlotKind{SegmentMerger::kKind, 2}};

}  // namespace

std::span<const SlotKind> chain_slots() {
  return kSlots;
}

std::string chain_text(bool scans) {
  std::string text;
  int last = -1;
  for (const SlotKind& slot : kSlots) {
    if (slot.stage == 0 && !scans) continue;
    text += text.empty() ? "" : slot.stage == last ? " or " : ", then ";
    text += slot.kind;
    last = slot.stage;
  }
  return text;
}

bool has_slot(const PipelineSpec& pipeline, std::string_view kind) {
  return std::ranges::find(pipeline.slots, kind, &ModuleChoice::kind) != pipeline.slots.end();
}

std::optional<ChainFault> chain_fault(const PipelineSpec& pipeline, bool scans) {
  const std::string& name = pipeline.name;
  const std::size_t count = pipeline.slots.size();
  const std::string allowed = "; allowed: " + chain_text(scans);
  const SlotKind* last = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& kind = pipeline.slots[i].kind;
    const auto slot = std::ranges::find(kSlots, kind, &SlotKind::kind);
    if (slot == kSlots.end()) return ChainFault{i, fmt::format("pipeline {} has a slot '{}'{}", name, kind, allowed)};
    if (slot->stage == 0 && !scans)
      return ChainFault{i,
                        fmt::format("pipeline {} has '{}', but there are no scans, only lines{}", name, kind, allowed)};
    if (last == nullptr && slot->stage != 0 && scans) break;
    if (last != nullptr && slot->stage == last->stage)
      return ChainFault{
          i, fmt::format("pipeline {} has both {} and {}; allowed: one of them", name, last->kind, slot->kind)};
    if (last != nullptr && slot->stage < last->stage)
      return ChainFault{i, fmt::format("pipeline {} has {} after {}{}", name, slot->kind, last->kind, allowed)};
    last = &*slot;
  }
  if (last != nullptr) return std::nullopt;
  return ChainFault{count, scans ? fmt::format("pipeline {} has no '{}'{}", name, kSlots.front().kind, allowed)
                                 : fmt::format("pipeline {} has no slot{}", name, allowed)};
}

}  // namespace scanbench::study
