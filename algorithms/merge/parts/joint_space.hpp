// Splitting of segments into pieces, the points of the centre-direction joint space (Lakaemper 2009, section IV.A, eq.
// 2).
#pragma once

#include <span>
#include <vector>

#include "core/line_map.hpp"

namespace scanbench::merge {

/// A part of an input line. Its direction is the line's, in [0, pi).
struct Piece {
  Segment segment;
  double alpha = 0.0;
  std::size_t line = 0;  ///< index of the input line
};

/// The pieces of all usable lines. Their order does not depend on the order of the lines, nor on which end of a line is
/// called a, except among lines equal in every number.
struct JointSpace {
  std::vector<Piece> pieces;
  std::size_t unusable = 0;  ///< number of lines skipped: not finite, without length, or beyond kFarthest
};

/// Lines with a coordinate beyond this many metres are not used.
inline constexpr double kFarthest = 1e9;
/// At coordinates above this number of standard deviations, a double is too coarse for a mode.
inline constexpr double kMostSigmas = 1e8;
/// More pieces are refused, because all stages together would take about 4 GiB.
inline constexpr double kMostPieces = 1e7;

/// Cuts every line into ceil(length / longest) equal pieces; one for longest = infinity. Throws ParamError for sigma_m,
/// before anything large is allocated, if that makes more than kMostPieces or a coordinate exceeds kMostSigmas.
JointSpace split_lines(std::span<const MapLine> lines, double sigma_m, double longest_m);

/// Mean of undirected directions, in [0, pi): half the angle of the sum of their unit vectors at doubled angles. If
/// these cancel (resultant below 1e-9), the first direction is returned. Needs at least one.
double mean_direction(std::span<const double> directions);

}  // namespace scanbench::merge
