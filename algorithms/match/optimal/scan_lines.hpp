// The lines of a scan as measurements: each with the covariance that the sensor's noise gives it.
// docs/algorithms/scan_matching.md, section 3.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace scanbench::matching {

/// A line in the frame of its sensor, or of another after moved(). The normal points away from the sensor that saw it.
struct MeasuredLine {
  Vec2 middle = Vec2::Zero();  ///< midpoint of the part that was seen, on the line
  Vec2 normal = Vec2::Zero();  ///< unit
  double half_length = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (offset along the normal at the middle, angle)
};

/// A return that no line explains.
struct LoneReturn {
  Vec2 point = Vec2::Zero();
  double sigma = 0.0;  ///< along its beam
};

/// What a scan measures.
struct ScanMeasurements {
  std::vector<MeasuredLine> lines;
  std::vector<LoneReturn> returns;
};

/// Lines and the rest of an observation. Lines are
/// - those of the observation that have a covariance: their own where the extractor gives one, else that of the line of
///   greatest likelihood through the returns that support it, which then takes the line's place;
/// - lines through runs of at least three returns that no line of the observation explains: walls that are short or
/// far,
///   which extractors leave out because so few returns make no line for sure. In a match a second scan has to confirm
///   them. A run is cut where two lines explain it better, until the misfit of each piece is what the noise allows.
ScanMeasurements measurements(const Observation& observation);

/// The line seen from another frame.
MeasuredLine moved(const Pose2& b_from_a, const MeasuredLine& line);

}  // namespace scanbench::matching
