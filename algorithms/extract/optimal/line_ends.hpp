// Lines whose last readings may belong to another surface. Where a wall ends at a step, the next readings are on the
// surface that joins the two walls (the side of a recess, for example), and the first of them fit the wall as well.
// docs/algorithms/optimal.md, section 5.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "algorithms/extract/optimal/line_tail.hpp"

namespace scanbench::extract {

/// A line and the readings, in scan order, that it was fitted to.
struct FittedReadings {
  const BeamLine& fit;
  std::span<const BeamReading> readings;
};

struct UncertainLine {
  BeamLine line;                 ///< mean over all hypotheses; information: inverse of the total covariance
  std::array<int, 2> foreign{};  ///< median number of readings at the first and last end that do not belong to the line
  std::array<double, 2> side{};  ///< probability that a side joins the line with the next one
};

/// The readings at one end that may be foreign: up to six.
struct UncertainEnd {
  int longest = 0;
  Tails tails;
  /// Density of the foreign readings, by their number, divided by the density of normal errors of 0: with a side that
  /// joins the line with the next one, and without. The former is a sum over where the side ends, with equal
  /// probabilities.
  std::array<double, kLongestTail + 1> with_side{};
  std::array<double, kLongestTail + 1> without_side{1.0};
};

/// An end of a line after which only the range of the next reading is known: a foreign reading is anywhere between the
/// line and that range, and each further foreign reading has probability 1/2. At least `min_readings` readings of the
/// line remain.
UncertainEnd end_towards_range(const FittedReadings& line, const ReadingNoise& noise, End end, double range_m,
                               int min_readings);

/// The last end of a line and the first end of the next, whose readings begin directly after it. A straight side may
/// join the two. At least `min_readings` readings of each line remain.
std::array<UncertainEnd, 2> ends_at_junction(const FittedReadings& line, const FittedReadings& next,
                                             const ReadingNoise& noise, int min_readings);

/// The maximum-likelihood line `fit`, averaged over the number of readings at each end that are foreign, and over the
/// begin and the end of a side. An end of default value is certain.
class UncertainEnds {
 public:
  UncertainEnds(const BeamLine& fit, const std::array<UncertainEnd, 2>& ends);

  /// `side_probability`: prior probability of a side between two lines, in (0, 1).
  UncertainLine average(double side_probability) const;

 private:
  // The line without i readings at its first end and j at its last.
  struct Hypothesis {
    double weight = 0.0;  // exp(gain)
    Vec2 step = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  // covariance + step step'
  };
  static constexpr std::size_t kNumbers = kLongestTail + 1;

  BeamLine fit_;
  std::array<UncertainEnd, 2> open_;
  std::array<std::array<Hypothesis, kNumbers>, kNumbers> hypotheses_;
};

}  // namespace scanbench::extract
