// One climb of mean shift inside a box, in float, until it converges, reaches a known mode or leaves the box.
#pragma once

#include <vector>

#include "algorithms/merge/mean_shift/kernel_sum.hpp"

namespace scanbench::merge {

enum class ClimbEnd { converged, captured, left_box, exhausted };

/// A known end of climbs, relative to the box centre.
struct Anchor {
  Float3 at;
  float squared_radius = 0.0F;
  int mode = -1;
};

/// Length of the longest accelerated step. It starts inside the inner box and must end inside the outer one.
inline constexpr float kLongestFastStep = 0.2F;

struct ClimbRules {
  float squared_cutoff = 16.0F;
  float tolerance = 1e-3F;  ///< without acceleration, a shift shorter than this ends the climb
  int max_steps = 5000;
  bool capture = true;
  bool accelerate = true;  ///< Newton steps where shifts are short
  Float3 inner;            ///< half sides of the box that an accelerated climb must not leave
  Float3 outer;            ///< half sides of the box in which all candidates are known; at least kLongestFastStep more
};

/// Moves t (relative to the box centre) uphill. `steps` counts the steps of the climb in all boxes. `captured_by` is
/// the index of the anchor if the result is `captured`. `path`, if not null, receives every new t.
ClimbEnd climb(const CandidateList& candidates, const std::vector<Anchor>& anchors, const ClimbRules& rules, Float3& t,
               int& steps, int& captured_by, std::vector<Float3>* path);

}  // namespace scanbench::merge
