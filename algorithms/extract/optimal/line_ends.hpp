// Lines whose last readings may belong to something else: where a wall ends at a step, the next readings lie on what
// joins the two surfaces (the side of a recess, say), and the first of them could as well be the wall's own.
// docs/algorithms/optimal.md, section 5.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "algorithms/extract/optimal/line_tail.hpp"

namespace scanbench::extract {

/// What lies beyond one end of a line: the next line and its readings in the order of the scan, the nearest of them
/// behind the line's own last one; or else the range of the next reading.
struct Beyond {
  std::optional<BeamLine> line;
  std::span<const BeamReading> readings;
  double range_m = 0.0;
};

struct UncertainLine {
  BeamLine line;                 ///< mean over where the line ends; information: inverse of the whole covariance
  std::array<int, 2> foreign{};  ///< readings at the first and at the last end that are not the line's: the median
  std::array<double, 2> side{};  ///< how probable it is that a side joins the line with the next one
};

/// What may be foreign at one end: up to six readings.
struct OpenEnd {
  int longest = 0;
  Tails tails;
  /// Density of so many foreign readings over that of normal errors of 0: where a side joins the line with the next
  /// one, and where none does. The first is a sum over where the side ends, all cuts being equally probable.
  std::array<double, kLongestTail + 1> with_side{};
  std::array<double, kLongestTail + 1> without_side{1.0};
};

/// The line of greatest likelihood `fit` of `readings`, averaged over how many readings at each end (up to six) are not
/// its own. Where another line follows, a straight side may join the two; where it begins and where it ends is averaged
/// over. Where only a range is known beyond, a foreign reading lies anywhere between the two, and whether there is a
/// further one is one bit. An end with nothing beyond is certain. At least `min_readings` of each line remain.
class UncertainEnds {
 public:
  UncertainEnds(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                const std::array<std::optional<Beyond>, 2>& beyond, int min_readings);

  /// `side_probability`: how probable a side between two lines is before the readings are looked at, in (0, 1).
  UncertainLine average(double side_probability) const;

 private:
  BeamLine fit_;
  std::array<OpenEnd, 2> open_;
};

}  // namespace scanbench::extract
