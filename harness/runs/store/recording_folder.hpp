// The folder of a recording, recordings/<scenario>/<seed>/. Reading it returns the same bits.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/recording.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/stored_files.hpp"

namespace scanbench::runs {

inline const RunFile kScanFile("recordings/*/*/scan.json");
inline const RunFile kRangesFile("recordings/*/*/ranges.npy");
inline const RunFile kTrueRangesFile("recordings/*/*/true_ranges.npy");

/// The files of a recording: name and bytes, in the order in which they enter the content hash. Walls, true ranges and
/// wall ids are absent without truth, lines.csv exists only if lines are given instead of scans, reference_poses.csv
/// and relations.csv only if a log has poses to compare with. `rotations.npy` (frames x 4: cos and sin of the true and
/// of the odometry yaw; NaN without truth) holds the exact unit vectors that the yaw columns of frames.csv round.
/// Throws ConfigError if frames have different numbers of beams.
std::vector<std::pair<std::string, std::string>> recording_files(const Recording& recording);

/// SHA-256 over name, length and bytes of every file but scan.json, which enters without its own `content_hash`.
std::string recording_hash(const Recording& recording);

/// Writes the files into an existing, empty folder (a StagedFolder's). Returns the content hash.
std::string write_recording(const std::filesystem::path& folder, const Recording& recording);

/// Saves a recording as a complete folder, which replaces an earlier one. Returns the content hash. Throws ConfigError.
std::string save_recording(const std::filesystem::path& folder, const Recording& recording);

/// Loads a recording. Throws ConfigError with the file's name if a file is missing or malformed, or if the bytes do not
/// have the content hash of scan.json (which is optional).
Recording load_recording(const StoredFiles& files);

/// The content hash and the number of scans that scan.json states; "" and 0 if it states none. Throws ConfigError.
std::string stated_recording_hash(const StoredFiles& recording);
double stated_scans(const StoredFiles& recording);

}  // namespace scanbench::runs
