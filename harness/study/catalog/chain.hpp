// The chain of a pipeline: the slots it may have, and their order. Scenario files, the executor and the lookup of
// modules all use this table.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "harness/study/catalog/pipeline_spec.hpp"

namespace scanbench::study {

/// A slot of the chain. Slots of one stage exclude each other.
struct SlotKind {
  std::string_view kind;  ///< kKind of the interface of its modules
  int stage = 0;          ///< 0: lines of each scan; 1: poses; 2: map
};

/// All slots in the order of the chain.
std::span<const SlotKind> chain_slots();

/// "extract, then align or match, then map or merge"; without the first stage if lines are given instead of scans.
std::string chain_text(bool scans);

/// True if the pipeline has a slot of this kind.
bool has_slot(const PipelineSpec& pipeline, std::string_view kind);

struct ChainFault {
  std::size_t slot = 0;  ///< index of the wrong slot; the number of slots if one is missing
  std::string message;
};

/// The first fault of a pipeline's chain, nullopt if it is valid. With `scans` it begins with stage 0; without, it has
/// at least one slot and none of stage 0.
std::optional<ChainFault> chain_fault(const PipelineSpec& pipeline, bool scans);

}  // namespace scanbench::study
