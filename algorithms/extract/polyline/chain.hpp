// A chain of walls seen from the sensor: vertices by bearing and inverse range, fitted to readings by maximum
// likelihood. docs/algorithms/polyline.md, sections 1 and 3.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/geometry.hpp"

namespace scanbench::extract {

/// A reading along a beam. Readings are ordered by increasing bearing; the scan of a scanner that rotates clockwise is
/// mirrored.
struct BearingReading {
  double bearing_rad = 0.0;
  double range_m = 0.0;
  double sigma_m = 1.0;
};

struct ChainVertex {
  double bearing_rad = 0.0;
  double inverse_range = 0.0;  ///< [1/m], positive
};

/// Vertices with increasing bearings, neighbours less than pi apart. A closed chain continues from its last vertex to
/// the first, 2 pi later. Between two vertices 1/r = a cos(bearing) + b sin(bearing): a straight wall.
struct Chain {
  std::vector<ChainVertex> vertices;
  bool closed = false;

  int walls() const { return static_cast<int>(vertices.size()) - (closed ? 0 : 1); }
  /// Vertex k, for a closed chain also k = vertices.size(): the first one, a turn later.
  ChainVertex vertex(int k) const;
  /// The wall at a bearing within the chain, numbered by its first vertex. For a closed chain the bearing may be up to
  /// a turn before or after.
  int wall_at(double bearing_rad) const;
  double inverse_range(int wall, double bearing_rad) const;
  /// Change of the range per radian of bearing.
  double slope(int wall, double bearing_rad) const;
};

/// The bearing wrapped to [first, first + 2 pi) for a closed chain; unchanged for an open one.
double within(const Chain& chain, double bearing_rad);

/// Sum of ((range - range of the chain) / sigma)^2 / 2.
double half_squares(const Chain& chain, std::span<const BearingReading> readings);

struct ChainFit {
  Chain chain;
  double half_squares = 0.0;
  Eigen::MatrixXd covariance;  ///< of (bearing, inverse range) of vertex k in rows 2k and 2k+1; 0 for what the readings
                               ///< do not determine
};

/// The maximum-likelihood chain near `start` with the same number of vertices: Levenberg-Marquardt on the bearings and
/// inverse ranges of all vertices. Each step assigns the readings to walls by bearing. The two ends of an open chain
/// keep their bearings.
ChainFit fit_chain(const Chain& start, std::span<const BearingReading> readings);

}  // namespace scanbench::extract
