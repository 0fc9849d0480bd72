// Exports recordings in formats that other programs read.
//
// carmen  FLASER lines if the beams have the angles that readers assume for it (log.hpp), else ROBOTLASER1 lines, which
//         state their angles. First pose triple: the true pose if there is one, else the odometry's; second: the
//         odometry's. Nothing in range: the value that the file's first line names, which goes into `no_return_m` when
//         it is read back; too close: half of the least range (0 if that is 0); no reading: 0.
// csv     One row per scan, t_s, x_m, y_m, yaw_rad (odometry), then the ranges; inf, -inf and nan are written as words.
// tum     Poses, "t x y z qx qy qz qw" (the RGB-D benchmark of TU Munich, 2012), the true ones if they are known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"

namespace scanbench::harness {

std::vector<std::string> export_formats();

/// The recording as text. Numbers are the shortest that read back to the same double. Throws ConfigError for an unknown
/// format.
std::string export_text(const Recording& recording, std::string_view format);

/// The options with which read_log() reads an export (carmen, csv) back to the same ranges.
ParamSet import_params(const Recording& recording, std::string_view format);

struct StampedPose {
  double stamp_s = 0.0;
  Pose2 world_from_sensor;
};

/// Poses in TUM format: of an estimate, for instance.
std::string tum_text(const std::vector<StampedPose>& poses);

}  // namespace scanbench::harness
