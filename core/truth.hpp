// The truth behind a simulated recording. No file of algorithms/ may include this header: tests/architecture holds it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pose2.hpp"

namespace scanbench {

/// A straight wall of the world. Its index in Truth::walls is the id that beams carry.
struct Wall {
  std::string label;
  Segment segment;
};

struct Truth {
  std::vector<Wall> walls;
  std::vector<Pose2> world_from_sensor;  ///< per frame, when its first beam fires
  std::vector<double> ranges;  ///< frames x beams, row-major: noise-free; +inf where the world returns nothing
  std::vector<std::int32_t>
      wall_ids;  ///< frames x beams: index into walls; -1: nothing, a round distractor or a moving body
};

}  // namespace scanbench
