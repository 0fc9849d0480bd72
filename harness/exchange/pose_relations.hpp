// Reads relation files: poses of scans relative to each other, as somebody measured them by other means.
//
// The format of the benchmark of Burgard, Stachniss, Grisetti, Steder, Kuemmerle et al., "A comparison of SLAM
// algorithms based on a graph of relations", IROS 2009; Kuemmerle et al., Autonomous Robots 27, 2009: rows
//   t1 t2 x y z roll pitch yaw
// with the pose of the robot at t2 in its frame at t1 (seconds, metres, radians). # begins a comment.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference_poses.hpp"

namespace scanbench::harness {

/// The relations between frames with these stamps; those of other stamps are skipped. A stamp is that of the nearest
/// frame within 1 ms. `robot_from_sensor` is the place of the sensor on the robot. Throws ConfigError with
/// file:line:col for rows of other than 8 numbers and for motions that leave the plane, and with the file's name if no
/// relation has both stamps.
std::vector<PoseRelation> parse_relations(std::string_view text, const std::string& file,
                                          std::span<const double> stamps_s, const Pose2& robot_from_sensor);

/// The same of a file, plain or gzip, of at most 64 MiB. Throws as read_text_file() does.
std::vector<PoseRelation> read_relations(const std::filesystem::path& path, std::span<const double> stamps_s,
                                         const Pose2& robot_from_sensor);

}  // namespace scanbench::harness
