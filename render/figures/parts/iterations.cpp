// Collects the rows of an aligner's trace by iteration.
#include "render/figures/parts/iterations.hpp"

#include <cstddef>
#include <iterator>

#include "core/contracts/force_field_trace.hpp"

namespace scanbench::render {
namespace {

constexpr int kDroppedFate = 3;

}  // namespace

const std::vector<std::vector<Vec2>>* AlignerIterations::hypotheses_at(int iteration) const {
  const auto after = hypotheses.upper_bound(iteration);
  return after == hypotheses.begin() ? nullptr : &std::prev(after)->second;
}

std::vector<std::string> keys_of_iterations() {
  return {key_of<force_field::PoseRow>(kAlignSlot), key_of<force_field::HypothesisRow>(kAlignSlot)};
}

AlignerIterations aligner_iterations(const TraceRows* trace, std::size_t scans) {
  AlignerIterations result;
  if (trace == nullptr) return result;
  for (const auto& row : rows_of<force_field::PoseRow>(*trace, kAlignSlot)) {
    if (row.scan < 0 || row.scan >= static_cast<int>(scans)) continue;
    auto& poses = result.poses[row.iteration];
    poses.resize(scans);
    poses[static_cast<std::size_t>(row.scan)] = Pose2(row.x_m, row.y_m, row.yaw_rad);
  }
  for (const auto& row : rows_of<force_field::HypothesisRow>(*trace, kAlignSlot)) {
    auto& of_iteration = result.hypotheses[row.iteration];  // none, if all of its rows are dropped ones
    if (row.fate != kDroppedFate)
      of_iteration.push_back({{row.x1_m, row.y1_m}, {row.x2_m, row.y2_m}, {row.x3_m, row.y3_m}, {row.x4_m, row.y4_m}});
  }
  return result;
}

}  // namespace scanbench::render
