// Where the next scan is expected: by the poses given with the scans, or without them.
#pragma once

#include <optional>
#include <string>

#include "core/geometry/pose2.hpp"

namespace scanbench::mapping {

enum class PredictionKind {
  odometry,          ///< the motion between the given poses
  constant_pose,     ///< no motion: the paper's, whose robots have no odometry
  constant_velocity  ///< the motion of the last step, scaled with time
};

/// Predicts the pose of each scan from where the scans before it were found. The first scan's frame is the frame of the
/// map, so that moving all given poses moves nothing here.
class Prediction {
 public:
  explicit Prediction(PredictionKind kind) : kind_(kind) {}

  /// The pose predicted for a scan, and what was odd about its input (empty: nothing). A given pose that is not finite,
  /// or a stamp that does not follow the last one, counts as no motion.
  struct Expected {
    Pose2 map_from_sensor;
    std::string remark;
  };
  Expected next(const Pose2& given, double stamp_s);
  /// The pose that the scan of the last next() was found at.
  void found(const Pose2& map_from_sensor);

 private:
  struct Seen {
    std::optional<Pose2> given;
    double stamp_s = 0.0;
    Pose2 found;
  };
  PredictionKind kind_;
  std::optional<Seen> last_, before_;
  Seen now_;
};

}  // namespace scanbench::mapping
