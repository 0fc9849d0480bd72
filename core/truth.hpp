// The truth behind a simulated recording. No file of algorithms/ may include this header; tests/architecture checks
// that.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace scanbench {

/// A straight wall of the world. Its index in Truth::walls is the id that beams carry.
struct Wall {
  std::string label;
  Segment segment;
};

struct Truth {
  std::vector<Wall> walls;
  std::vector<Pose2> world_from_sensor;  ///< per frame, when its first beam fires
  std::vector<double> ranges;            ///< frames x beams, row-major, noise-free; +inf: the beam hits nothing
  std::vector<std::int32_t> wall_ids;    ///< frames x beams, index into walls; -1: no wall (nothing, a circle, a body)
};

}  // namespace scanbench
