// Lines whose last readings may belong to another surface. Where a wall ends at a step, the next readings are on the
// surface that joins the two walls (the side of a recess, for example), and the first of them fit the wall as well.
// docs/algorithms/optimal.md, section 5.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "algorithms/extract/optimal/line_tail.hpp"

namespace scanbench::extract {

/// The neighbour of one end of a line: the next line with its readings in scan order, which begin directly after the
/// last reading of the line; or, without a next line, the range of the next reading.
struct Adjacent {
  std::optional<BeamLine> line;
  std::span<const BeamReading> readings;
  double range_m = 0.0;
};

struct UncertainLine {
  BeamLine line;                 ///< mean over all hypotheses; information: inverse of the total covariance
  std::array<int, 2> foreign{};  ///< median number of readings at the first and last end that do not belong to the line
  std::array<double, 2> side{};  ///< probability that a side joins the line with the next one
};

/// The readings at one end that may be foreign: up to six.
struct UncertainEnd {
  int longest = 0;
  Tails tails = Tails(1);
  /// Density of the foreign readings, by their number, divided by the density of normal errors of 0: with a side that
  /// joins the line with the next one, and without. The former is a sum over where the side ends, with equal
  /// probabilities.
  std::array<double, kLongestTail + 1> with_side{};
  std::array<double, kLongestTail + 1> without_side{1.0};
};

/// The maximum-likelihood line `fit` of `readings`, averaged over the number of readings at each end (up to six) that
/// are foreign. Where another line follows, a straight side may join the two; the estimate is averaged over the begin
/// and the end of the side. Where only the next range is known, a foreign reading is anywhere between the line and that
/// range, and each further foreign reading has probability 1/2. An end without an adjacent reading is certain. At least
/// `min_readings` readings of each line remain.
class UncertainEnds {
 public:
  UncertainEnds(const BeamLine& fit, std::span<const BeamReading> readings, const SensorNoise& noise,
                const std::array<std::optional<Adjacent>, 2>& adjacent, int min_readings);

  /// `side_probability`: prior probability of a side between two lines, in (0, 1).
  UncertainLine average(double side_probability) const;

 private:
  BeamLine fit_;
  std::array<UncertainEnd, 2> open_;
};

}  // namespace scanbench::extract
