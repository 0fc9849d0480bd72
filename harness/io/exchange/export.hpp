// Exports recordings in formats that other programs read.
//
// carmen  FLASER lines if the beams have the angles that readers assume for it (log.hpp), else ROBOTLASER1 lines, which
//         state their angles. The first pose triple is the true pose if known, else the odometry's; the second is the
//         odometry's. Nothing in range is written as the value named in the file's first line, which is the
//         `no_return_m` of an import; too close as half of the least range (0 if that is 0); no reading as 0.
// csv     One row per scan, t_s, x_m, y_m, yaw_rad (odometry), then the ranges; inf, -inf and nan are written as words.
// tum     Poses, "t x y z qx qy qz qw" (the RGB-D benchmark of TU Munich, 2012), the true poses if they are known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"

namespace scanbench::io {

std::vector<std::string> export_formats();

/// The recording as text. Numbers have the shortest form that reads back to the same double. Throws ConfigError for an
/// unknown format.
std::string export_text(const Recording& recording, std::string_view format);

/// The options with which read_log() reads an export (carmen, csv) back to the same ranges.
ParamSet import_params(const Recording& recording, std::string_view format);

struct StampedPose {
  double stamp_s = 0.0;
  Pose2 world_from_sensor;
};

/// Poses in TUM format, for instance of an estimate.
std::string tum_text(const std::vector<StampedPose>& poses);

}  // namespace scanbench::io
