// What a recorded log says of its own poses, for comparison with estimated ones. No file of algorithms/ may include
// this header; tests/architecture checks that.
#pragma once

#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench {

/// The pose of the sensor at frame `second` in that at frame `first`, as somebody measured it by other means.
struct PoseRelation {
  int first = 0;
  int second = 0;
  Pose2 first_from_second;
};

struct ReferencePoses {
  std::vector<Pose2> world_from_sensor;  ///< per frame; empty: none
  std::vector<PoseRelation> relations;   ///< in the order of their file; may be empty
};

}  // namespace scanbench
