// Recordings of lines instead of scans: superimposed copies of a world's walls, as in the data set "Spiral" of
// Lakaemper, "Simultaneous multi-line-segment merging for robot mapping using mean shift clustering", IROS 2009,
// figures 1 to 3.
#pragma once

#include <cstdint>
#include <tuple>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "sim/world.hpp"

namespace scanbench::sim {

/// Each copy is rotated about the world's origin and then shifted; both are normally distributed and independent.
struct LineCopies {
  int copies = 10;
  double rotation_sigma_rad = 0.0;
  double shift_sigma_m = 0.0;  ///< of each coordinate

  static auto fields() {
    using C = LineCopies;
    return std::tuple{field("copies", &C::copies, between(1, 10000), "", "number of copies of every wall"),
                      degrees_field("rotation_sigma_deg", &C::rotation_sigma_rad, at_least(0),
                                    "standard deviation of a copy's rotation about the world's origin"),
                      field("shift_sigma_m", &C::shift_sigma_m, at_least(0), "m",
                            "standard deviation of each coordinate of a copy's shift")};
  }
};

/// One frame per copy, without beams: its lines are the walls at their true places, its odometry is the copy's pose,
/// its true pose is the origin. The truth has the walls; no beam saw them, so all of them count as visible. Throws
/// ConfigError for a world that validate() refuses.
Recording line_copies(const World& world, const LineCopies& copies, std::uint64_t seed);

}  // namespace scanbench::sim
