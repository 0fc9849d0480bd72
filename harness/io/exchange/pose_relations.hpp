// Reads relation files: poses of scans relative to each other, as somebody measured them by other means.
//
// Two kinds of rows. That of the benchmark of Burgard, Stachniss, Grisetti, Steder, Kuemmerle et al., "A comparison of
// SLAM algorithms based on a graph of relations", IROS 2009; Kuemmerle et al., Autonomous Robots 27, 2009:
//   t1 t2 x y z roll pitch yaw
// with the pose of the robot at t2 in its frame at t1 (seconds, metres, radians). And that of graph logs:
//   EDGE2 i j x y yaw [six numbers of information]
// with the pose of the robot at scan j of the log in its frame at scan i, counted from 0. All other rows that begin
// with a word in capitals are skipped, so that a graph log is its own file of relations. # begins a comment.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference_poses.hpp"

namespace scanbench::io {

/// All scans of a log, and which of them are frames of the recording.
struct RelatedScans {
  std::vector<double> stamps_s;          ///< of every scan of the log
  std::vector<Pose2> world_from_sensor;  ///< of every scan, by the log itself; as many as stamps
  std::size_t every = 1;                 ///< scans 0, every, 2 every, ... are frames 0, 1, 2, ...
  std::size_t frames = 0;                ///< number of frames
};

/// The relations between frames. A stamp is that of the nearest scan within 1 ms. A relation of a scan that is not a
/// frame moves to the nearest one that is, by the poses of the log: between scans so near, their errors are those of a
/// relation. In a log whose poses are all equal it is skipped. Skipped are also relations that then join a frame with
/// itself, and stamps that no scan has. `robot_from_sensor` is the place of the sensor on the robot. Throws ConfigError
/// with file:line:col for other rows, for motions that leave the plane and for scans beyond the last, and with the
/// file's name if no relation is between two frames.
std::vector<PoseRelation> parse_relations(std::string_view text, const std::string& file, const RelatedScans& scans,
                                          const Pose2& robot_from_sensor);

/// The same of a file, plain or gzip, of at most 64 MiB. Throws as read_text_file() does.
std::vector<PoseRelation> read_relations(const std::filesystem::path& path, const RelatedScans& scans,
                                         const Pose2& robot_from_sensor);

}  // namespace scanbench::io
