// A scan as the optimal extractors describe it: which returns take part, and what each costs on a line, as clutter, or
// across missing beams. docs/algorithms/optimal.md, section 2.
#pragma once

#include <span>
#include <vector>

#include "algorithms/extract/optimal_segmentation.hpp"
#include "core/scan.hpp"

namespace scanbench::extract {

/// What is known about the wall behind a return.
struct KnownWall {
  double range = 0.0;  ///< 0: unknown
  double slope = 0.0;  ///< change of range per radian of bearing
};

/// The returns of a scan without those far in front of their neighbours, if the sensor gives spurious returns: to a
/// line they say nothing, and it goes on behind them. The scan and the noise must outlive it.
class ScanModel {
 public:
  ScanModel(const Scan& scan, const SensorNoise& noise);

  const ScanPoints& points() const { return points_; }
  const std::vector<double>& ranges() const { return ranges_; }
  std::size_t size() const { return ranges_.size(); }
  const Vec2& direction(std::size_t i) const { return scan_.sensor.geometry.direction(points_.beams[i]); }

  /// Range around return i without the noise of one reading and without a spurious neighbour: median of five.
  double smoothed_range(std::size_t i) const;

  /// Code length [nats] of a place in the scan. There must be a return.
  double place_cost() const;

  /// Returns as the dynamic programmes see them; `walls` is empty or has one entry per return.
  std::vector<SegmentationPoint> segmentation_points(std::span<const KnownWall> walls) const;

 private:
  double gap_cost(std::size_t i) const;

  const Scan& scan_;
  const SensorNoise& noise_;
  ScanPoints points_;
  std::vector<double> ranges_;
};

}  // namespace scanbench::extract
