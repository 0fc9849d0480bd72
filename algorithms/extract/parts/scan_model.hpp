// Code lengths of the returns of a scan: the returns that a description by lines contains, and the cost of each on a
// line, as clutter and across missing beams. docs/algorithms/optimal.md, section 2.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/scan.hpp"

namespace scanbench::extract {

/// A return in the dynamic programmes. A line is theta . direction = inverse range, which is linear in theta.
struct SegmentationPoint {
  Vec2 direction = Vec2::Zero();  ///< unit vector of the beam
  double inverse_range = 0.0;     ///< [1/m]
  double weight = 0.0;            ///< converts a squared error of the inverse range into one in standard deviations
  double line_cost = 0.0;         ///< code length [nats] of a return exactly on its line
  double clutter_cost = 0.0;      ///< code length of a return on no line
  /// Code length of the missing beams since the point before if one line continues across them; infinite if none can.
  double gap_cost = 0.0;
};

/// The wall at a return, known from a fitted line.
struct KnownWall {
  double range = 0.0;  ///< range of the wall along the beam [m]; 0: unknown
  double slope = 0.0;  ///< change of range per radian of bearing
};

/// The returns of a scan that are described. If the sensor gives spurious returns, those far in front of their
/// neighbours are skipped, and lines continue behind them. The scan and the noise must outlive the model.
class ScanModel {
 public:
  ScanModel(const Scan& scan, const SensorNoise& noise);

  const ScanPoints& points() const { return points_; }
  const std::vector<double>& ranges() const { return ranges_; }
  std::size_t size() const { return ranges_.size(); }
  const Vec2& direction(std::size_t i) const { return scan_.sensor.geometry.direction(points_.beams[i]); }

  /// The median of the five ranges around return i. It suppresses the noise of one reading and one spurious neighbour.
  double smoothed_range(std::size_t i) const;

  /// Code length [nats] of a place in the scan: the logarithm of the number of returns, which must be at least one.
  double place_cost() const;

  /// All returns; `walls` is empty or has one entry per return.
  std::vector<SegmentationPoint> segmentation_points(std::span<const KnownWall> walls) const;

 private:
  double gap_cost(std::size_t i) const;

  const Scan& scan_;
  const SensorNoise& noise_;
  ScanPoints points_;
  std::vector<double> ranges_;
};

}  // namespace scanbench::extract
