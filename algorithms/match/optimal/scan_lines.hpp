// The lines of a scan as measurements: each with the covariance that the sensor's noise gives it.
// docs/algorithms/scan_matching.md, section 3.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace scanbench::matching {

/// A line in the frame of its sensor, or of another after moved(). The normal points away from the sensor that saw it.
/// An extractor's line and covariance are means over what it doubts: where the wall ends, whether it has a hidden
/// break. The plain line is the one of greatest likelihood through the same readings if nothing is in doubt.
struct MeasuredLine {
  Vec2 middle = Vec2::Zero();  ///< midpoint of the part that was seen, on the line
  Vec2 normal = Vec2::Zero();  ///< unit
  double half_length = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();   ///< of (offset along the normal at the middle, angle)
  Eigen::Vector2d plain_place = Eigen::Vector2d::Zero();  ///< (offset, angle) of the plain line from this one
  Eigen::Matrix2d plain_covariance = covariance;          ///< by the noise of the readings alone
};

/// A return that no line explains.
struct LoneReturn {
  Vec2 point = Vec2::Zero();
  double sigma = 0.0;  ///< along its beam
};

/// The measurements of one scan.
struct ScanMeasurements {
  std::vector<MeasuredLine> lines;
  std::vector<LoneReturn> returns;
};

/// The lines of an observation, and its other returns. Lines are
/// - those of the observation, with the extractor's covariance; a line without one is replaced by the line of greatest
///   likelihood through the returns that support it;
/// - lines through runs of at least three returns that no line of the observation explains. These are walls that are
///   short or far, which extractors leave out because so few returns are no safe evidence of a line. In a match, a
///   second scan has to confirm them. A run is cut where two lines explain it better, until the noise allows the misfit
///   of each piece.
ScanMeasurements measurements(const Observation& observation);

/// The same line in another frame.
MeasuredLine moved(const Pose2& b_from_a, const MeasuredLine& line);

}  // namespace scanbench::matching
