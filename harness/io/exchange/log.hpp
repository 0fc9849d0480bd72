// Reads recorded logs: the scans of a real sensor. Gzip files are unpacked.
//
// carmen   FLASER and ROBOTLASER1 lines; all other messages are skipped. FLASER states no beam angles, and public
//          readers disagree by up to 17 cm at 10 m; the rule here: -90 deg + i * 180/n for n = 180 and 360 beams,
//          -90 deg + i * 180/(n-1) for 181 and 361; any other n needs first_angle_deg and step_deg. ROBOTLASER1 states
//          its angles. A log that holds both gives the scans of the message that comes first.
//          Poses: `reference` is the first pose triple of a line (the laser's), `odometry` the second (the robot's),
//          `vertex` the VERTEX2 line before the scan in a graph log; `none` gives scans without odometry. With
//          compare_poses another pose of the log is kept apart, for comparison with estimates.
// dpslam   "Odometry x y theta" and "Laser n r1 .. rn" alternate; beam angles follow the same rule.
// csv      one scan per row, fields separated by commas or blanks, # begins a comment; `columns` names them:
//          t_s t_ms t_us  x_m x_cm x_mm  y_m y_cm y_mm  yaw_rad yaw_deg  skip skip:20  ranges
//          "inf", "-inf" and "nan" are allowed among the ranges.
//
// Scanners whose number of beams changes from scan to scan: with span_deg the beams of each scan divide that angle.
// Scans that differ from the first are refused (angles: same) or resampled to its beams (resampled): each of these gets
// the reading of the nearest beam, at most half a step away, or NaN if there is none.
//
// Readings follow REP-117. 0, negative values and NaN mean no reading (NaN); values below range_min_m mean too close
// (-inf); values of no_return_m or more (if that is > 0) mean nothing in range (+inf).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"

namespace scanbench::io {

std::vector<std::string> log_formats();

/// The options of a format, with units, bounds and docs. Throws ConfigError for an unknown format.
std::vector<ParamSpec> log_param_specs(std::string_view format);

/// The options that a scenario must give, because neither the log nor the format has them.
std::vector<std::string> required_log_params(std::string_view format);

/// Throws ParamError for options that fit no log of the format: wrong `columns`, no `step_deg`.
void check_log_params(std::string_view format, const ParamSet& params);

/// Description of a format for the help text.
struct LogFormatText {
  std::string summary;
  std::vector<std::string> notes;  ///< rules that the options alone do not show
};
LogFormatText log_format_text(std::string_view format);

/// The place of the sensor in the frame whose poses the log holds, as the options state it.
Pose2 sensor_place(std::string_view format, const ParamSet& params);

/// The scans of a log. `sensor` gives name, noise and timing; beam angles and range limits come from the log and its
/// options. Stamps are the log's, or one scan period of the sensor apart if it has none. The recording has no truth.
/// Throws ConfigError with file:line:col for a truncated line, fields that are not numbers, beams that change unless
/// the options allow it, and a log without scans. A log that needs more than max_bytes is refused before any of its
/// text is kept. Throws as read_text_file() does.
Recording read_log(const std::filesystem::path& path, std::string_view format, const ParamSet& params,
                   const SensorModel& sensor, double max_bytes);

/// The same from memory; `file` is for messages.
Recording parse_log(std::string_view text, const std::string& file, std::string_view format, const ParamSet& params,
                    const SensorModel& sensor);

}  // namespace scanbench::io
