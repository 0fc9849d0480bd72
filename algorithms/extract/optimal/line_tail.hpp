// The line without some of the readings at its ends, computed by removing them from the normal equations.
// docs/algorithms/optimal.md, section 5.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "algorithms/extract/parts/beam_line.hpp"

namespace scanbench::extract {

/// Sums over the outermost readings of one end of a line: their share of its normal equations.
struct Tail {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Vec2 gradient = Vec2::Zero();  ///< sum of g e / s^2: gradient g, residual e, standard deviation s
  double half_squares = 0.0;
};

inline constexpr int kLongestTail = 6;
using Tails = std::array<Tail, kLongestTail + 1>;  ///< indexed by the number of readings, from 0

enum class End { first, last };

/// Reading k of an end, counted from the outermost one.
const BeamReading& reading_from_end(std::span<const BeamReading> readings, End end, std::size_t k);

/// The tails of 0 to `longest` readings, up to kLongestTail.
Tails tails_of(const BeamLine& fit, std::span<const BeamReading> readings, const ReadingNoise& noise, End end,
               int longest);

/// The share of one reading in the normal equations of its line, whose range along the beam is r.
Tail tail_of(const BeamLine& fit, const BeamReading& reading, double r, const ReadingNoise& noise);

/// A line fitted without its tail.
struct Shortened {
  Vec2 theta = Vec2::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< covariance of theta
  double gain = 0.0;                                     ///< decrease of half the sum of squared errors
  bool valid = false;                                    ///< false: the remaining readings determine no line
};

Shortened without_tail(const BeamLine& fit, const Tail& tail);
Tail operator+(const Tail& a, const Tail& b);

}  // namespace scanbench::extract
