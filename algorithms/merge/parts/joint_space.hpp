// Centre-direction joint space of segments and the splitting of long ones (Lakaemper 2009, section IV.A, eq. 2).
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

/// The pieces of all usable lines in an order that does not depend on the order of the lines nor on which end of a
/// line is called a, except among lines equal in every number.
struct JointSpace {
  std::vector<Piece> pieces;
  std::size_t unusable = 0;  ///< lines left out: not finite, without length, or beyond kFarthest
};

/// Lines with a coordinate beyond this many metres are taken for garbage.
inline constexpr double kFarthest = 1e9;
/// Coordinates larger than this many standard deviations leave no digits for a mode.
inline constexpr double kMostSigmas = 1e8;
/// More pieces than this are refused: they would take about 4 GiB in all stages together.
inline constexpr double kMostPieces = 1e7;

/// Cuts every line into ceil(length / longest) equal pieces, one for longest = infinity. Throws ParamError, naming
/// sigma_m, when that makes more than kMostPieces or a coordinate is larger than kMostSigmas; nothing large is
/// allocated before this is known.
JointSpace split_lines(std::span<const MapLine> lines, double sigma_m, double longest_m);

/// Mean of undirected directions, in [0, pi): half the angle of the summed doubled ones. Directions that cancel out
/// (resultant below 1e-9) have none; then the first one is returned. Needs at least one.
double mean_direction(std::span<const double> directions);

}  // namespace scanbench::merge
