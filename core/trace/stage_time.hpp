// CPU times of the stages of modules, and how timing.csv names them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/trace/stage.hpp"

namespace scanbench {

/// Thread CPU time of one stage of one module on one frame; frame -1: the whole recording.
struct StageTime {
  std::string slot = "extract";  ///< the module's kind
  std::optional<Stage> stage;    ///< absent: all the work of a module that names no stages
  int frame = -1;
  double seconds = 0.0;

  bool of_extraction() const { return slot == "extract"; }
  /// As in timing.csv: "pre" of the slot `extract`, "merge.phase1" of any other slot, "align" for all of a slot's work.
  std::string label() const;
};

/// The slot and the stage of a label, with seconds 0; nullopt for a label that names neither.
std::optional<StageTime> stage_time_labelled(std::string_view label, int frame);

}  // namespace scanbench
