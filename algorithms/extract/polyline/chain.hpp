// A chain of walls seen from the sensor: vertices by bearing and inverse range, fitted to readings by maximum
// likelihood. docs/algorithms/polyline.md, sections 1 and 3.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry.hpp"

namespace scanbench::extract {

/// A reading along a beam, in the order in which the chain is seen. Bearings increase; a scanner that turns clockwise
/// is seen in a mirror.
struct BearingReading {
  double bearing_rad = 0.0;
  double range_m = 0.0;
  double sigma_m = 1.0;
};

struct ChainVertex {
  double bearing_rad = 0.0;
  double inverse_range = 0.0;  ///< [1/m], positive
};

/// Vertices with increasing bearings, neighbours less than pi apart. A closed chain goes on from its last vertex to the
/// first, 2 pi later. Between two vertices 1/r = a cos(bearing) + b sin(bearing): a straight wall.
struct Chain {
  std::vector<ChainVertex> vertices;
  bool closed = false;

  int walls() const { return static_cast<int>(vertices.size()) - (closed ? 0 : 1); }
  /// Vertex k, for a closed chain also k = vertices.size(): the first one, a turn later.
  ChainVertex vertex(int k) const;
  /// The wall that a bearing within the chain meets; for a closed chain the bearing may lie up to a turn before or
  /// after. Walls count from their first vertex.
  int wall_at(double bearing_rad) const;
  double inverse_range(int wall, double bearing_rad) const;
  /// Change of range per radian of bearing.
  double slope(int wall, double bearing_rad) const;
};

/// The bearing within [first, first + 2 pi) of a closed chain, as it is for an open one.
double within(const Chain& chain, double bearing_rad);

/// Sum of ((range - chain) / sigma)^2 / 2.
double half_squares(const Chain& chain, std::span<const BearingReading> readings);

struct ChainFit {
  Chain chain;
  double half_squares = 0.0;
  Eigen::MatrixXd covariance;  ///< of (bearing, inverse range) of all vertices, row 2k and 2k+1; what the readings say
                               ///< nothing of has the variance 0
};

/// The chain of greatest likelihood near `start`, with as many vertices: Levenberg-Marquardt on bearings and inverse
/// ranges of all of them, readings assigned to walls by bearing in each step. The two ends of an open chain keep their
/// bearings.
ChainFit fit_chain(const Chain& start, std::span<const BearingReading> readings);

}  // namespace scanbench::extract
