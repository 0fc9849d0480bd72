// The pose of a scan by its match with the scan before: a better start for the alignment with the map than odometry.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace scanbench::mapping {

/// Keeps the last scan and matches the next one with it. Wheels that slip lose headings first, so where less than 70 %
/// of the returns are on those of the last scan, predictions turned about the sensor by multiples of 10 degrees up to
/// `search_rad` are tried too, and the match with the largest share counts.
class StepMatching {
 public:
  /// `matcher`: the name of a registered one, or "none". Throws ParamError with the parameter's name for any other.
  StepMatching(const std::string& matcher, const std::string& parameter, double search_rad);

  /// Pose of the scan in the frame of the map; absent for the first scan, without a matcher or match, for scans
  /// without beams, and if less than half of the returns are within 10 cm of those of the last scan.
  std::optional<Pose2> pose(const Observation& scan, const Pose2& predicted) const;
  /// The scan becomes the last one.
  void found(const Observation& scan, const Pose2& map_from_sensor);

 private:
  struct Last {
    SensorModel sensor;
    std::vector<double> ranges;
    double stamp_s = 0.0;
    ScanLines lines;
    Pose2 map_from_sensor;
    Scan scan() const { return {sensor, ranges, stamp_s}; }
  };
  double search_rad_;
  std::unique_ptr<ScanMatcher> matcher_;
  std::optional<Last> last_;
};

}  // namespace scanbench::mapping
