// The trace of the aligners ffs and virtual_scans: poses and hypotheses by iteration.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/trace/trace_rows.hpp"

namespace scanbench::render {

inline constexpr std::string_view kAlignSlot = "align";

struct AlignerIterations {
  std::map<int, std::vector<Pose2>> poses;                   ///< of all scans, after the iteration
  std::map<int, std::vector<std::vector<Vec2>>> hypotheses;  ///< corners of those that were not dropped

  /// Those of the iteration, or of the last one before it that has any row: hypotheses are made before an iteration, so
  /// those of the last one belong to the final poses too. nullptr if there is none.
  const std::vector<std::vector<Vec2>>* hypotheses_at(int iteration) const;
};

/// For Figure::trace_rows(): the keys of the rows that it is made from.
std::vector<std::string> keys_of_iterations();

/// Empty without a trace. Rows of scans from `scans` on are left out.
AlignerIterations aligner_iterations(const TraceRows* trace, std::size_t scans);

}  // namespace scanbench::render
