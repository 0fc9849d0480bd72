// Lines whose last readings may belong to something else: where a wall ends at a step, the next readings lie on what
// joins the two surfaces (the side of a recess, say), and the first of them could as well be the wall's own.
// docs/algorithms/optimal.md, section 5.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "algorithms/extract/optimal_line.hpp"

namespace scanbench::extract {

/// What lies beyond one end of a line: the next line, or else the range of the next reading.
struct Beyond {
  std::optional<BeamLine> line;
  double range_m = 0.0;

  double range(const Vec2& direction) const { return line ? line->range(direction) : range_m; }
};

struct UncertainLine {
  BeamLine line;                 ///< mean over where the line ends; information: inverse of the whole covariance
  std::array<int, 2> foreign{};  ///< readings at the first and at the last end that are most likely not the line's
};

/// The line of greatest likelihood `fit` of `readings`, averaged over how many readings at each end (up to six) are of
/// what joins the line with that beyond: such a reading lies anywhere between the two, and whether there is a further
/// one is one bit. An end with nothing beyond is certain. At least `min_readings` remain.
UncertainLine with_uncertain_ends(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                                  const std::array<std::optional<Beyond>, 2>& beyond, int min_readings);

}  // namespace scanbench::extract
