// Lines that may cover two walls. Where two walls are nearly on one line, a second line would not pay for its code, and
// one line describes both. docs/algorithms/optimal.md, section 5.
#pragma once

#include <span>

#include "algorithms/extract/parts/beam_line.hpp"

namespace scanbench::extract {

/// The hypotheses that a line is two walls that meet, or miss each other, between two of its readings: one hypothesis
/// per place, all equally probable. Under each of them the line is the wall that shows the longer piece.
class HiddenBreak {
 public:
  /// `fit` is the maximum-likelihood line of `readings`. Each part has at least `min_readings` readings; with fewer
  /// than twice as many readings there is no hypothesis.
  HiddenBreak(const BeamLine& fit, std::span<const BeamReading> readings, const ReadingNoise& noise, int min_readings);

  /// Is there a place for a break?
  bool possible() const { return places_ > 0; }
  /// Density of the readings with a break somewhere, divided by that without.
  double bayes_factor() const { return bayes_factor_; }
  /// Probability of a break after the readings, from that before them.
  double probability(double prior) const;
  /// `line`, an estimate that assumes one wall, averaged over all hypotheses.
  BeamLine average(const BeamLine& line, double prior) const;

 private:
  int places_ = 0;
  double bayes_factor_ = 0.0;
  // Averages over the places, weighted by density: of the step from the line of all readings to that of the longer
  // part, and of what the covariance grows by plus the square of the step.
  Vec2 step_ = Vec2::Zero();
  Eigen::Matrix2d second_ = Eigen::Matrix2d::Zero();
};

}  // namespace scanbench::extract
