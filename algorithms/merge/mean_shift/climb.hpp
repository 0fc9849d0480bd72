// One climb of mean shift inside one box: float steps until it converges, reaches a known mode or leaves the box.
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

/// The longest accelerated step. It is tried from inside the inner box and must end inside the outer one.
inline constexpr float kLongestFastStep = 0.2F;

struct ClimbRules {
  float squared_cutoff = 16.0F;
  float tolerance = 1e-3F;  ///< of eq. 1 alone: a shorter shift ends the climb
  int max_steps = 5000;
  bool capture = true;
  bool accelerate = true;  ///< Newton steps where shifts are short
  Float3 inner;            ///< half sides of the box that a slow climb must not leave
  Float3 outer;            ///< at least kLongestFastStep more: where the candidates are complete
};

/// Moves t (relative to the box centre) uphill. `steps` counts over all boxes of one climb. `captured_by` is the index
/// of the anchor when the answer is captured. `path`, if not null, receives every new t.
ClimbEnd climb(const CandidateList& candidates, const std::vector<Anchor>& anchors, const ClimbRules& rules, Float3& t,
               int& steps, int& captured_by, std::vector<Float3>* path);

}  // namespace scanbench::merge
