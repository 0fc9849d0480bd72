// What the log readers share: options, lines with their numbers, and the recording that grows frame by frame.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "harness/files/placed_error.hpp"

namespace scanbench::harness {

enum class LogPoses { reference, odometry, vertex };

/// Options of all formats; log_param_specs() names those of each.
struct LogOptions {
  LogPoses poses = LogPoses::reference;
  double no_return_m = 0.0;
  double range_min_m = 0.0;
  double first_angle_deg = -90.0;
  double step_deg = 0.0;
  std::string columns = "ranges";
  int skip_lines = 0;
  int beams = 0;
  double unit_m = 1.0;
  int every = 1;
  int max_frames = 0;
  double sensor_x_m = 0.0;
  double sensor_y_m = 0.0;
  double sensor_yaw_deg = 0.0;
  static auto fields() {
    using O = LogOptions;
    return std::tuple{
        choice("poses", &O::poses,
               {{LogPoses::reference, "reference"}, {LogPoses::odometry, "odometry"}, {LogPoses::vertex, "vertex"}},
               "which pose of a scan to take: the first triple, the second, or the VERTEX2 line before it"),
        field("no_return_m", &O::no_return_m, at_least(0), "m",
              "readings from here on mean nothing in range; 0: none do"),
        field("range_min_m", &O::range_min_m, at_least(0), "m", "readings below are too close"),
        field("first_angle_deg", &O::first_angle_deg, between(-360, 360), "deg", "of beam 0; read only with step_deg"),
        field("step_deg", &O::step_deg, between(-360, 360), "deg", "between beams; 0: what the format says"),
        field("columns", &O::columns, "names of the columns of a row"),
        field("skip_lines", &O::skip_lines, between(0, 1e6), "", "lines to pass over at the top"),
        field("beams", &O::beams, between(0, 1e6), "", "ranges in a row; 0: as many as the first row has"),
        field("unit_m", &O::unit_m, above(0), "m", "metres per unit of the ranges"),
        field("every", &O::every, between(1, 1e6), "", "take every n-th scan"),
        field("max_frames", &O::max_frames, between(0, 1e9), "", "stop after so many scans; 0: all"),
        field("sensor_x_m", &O::sensor_x_m, any_number(), "m", "place of the sensor in the frame of the log's poses"),
        field("sensor_y_m", &O::sensor_y_m, any_number(), "m", "place of the sensor in the frame of the log's poses"),
        field("sensor_yaw_deg", &O::sensor_yaw_deg, between(-360, 360), "deg",
              "direction of the sensor in that frame")};
  }
};

/// The lines of a log, one at a time, with what messages need to know about them.
class LogLines {
 public:
  explicit LogLines(std::string_view text) : rest_(text) {}

  /// False at the end.
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }
  /// True if the file ends with this line and without a line break.
  bool cut_short() const { return ends_open_; }

  [[noreturn]] void refuse(std::string_view word, const std::string& message) const;
  /// Refuses an open last line whose last number has fewer decimals than the 32 before it, which agree: it was cut
  /// inside that number. Numbers of varying width, and whole ones, do not show it.
  void check_last_number(const std::vector<std::string_view>& words) const;
  /// A finite number; throws PlacedError naming `what`.
  double number_of(std::string_view word, std::string_view what) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
  bool ends_open_ = false;
};

/// Degrees of the first beam and between beams.
struct BeamAngles {
  double first_deg;
  double step_deg;
};

class LogBuilder {
 public:
  explicit LogBuilder(const LogOptions& options);

  /// True if the next scan is one to keep; call once per scan.
  bool wants_scan();
  /// True when no further scan is wanted.
  bool full() const;

  /// Checks the count of ranges against the first scan's; throws PlacedError naming both lines.
  void check_beams(const LogLines& lines, std::size_t beams);
  /// The angles that the options give, or else the rule for scanners of 180 degrees (log.hpp).
  BeamAngles angles_by_rule(const LogLines& lines, std::size_t beams) const;
  /// Checks the angles against the first scan's.
  void check_angles(const LogLines& lines, const BeamAngles& angles);

  /// A pose of the log (m, rad), moved to the sensor. Throws PlacedError for a heading that is no angle.
  Pose2 pose(const LogLines& lines, double x_m, double y_m, double yaw_rad) const;

  /// A range in metres as REP-117 wants it.
  double reading(double range_m) const;

  void add(Frame frame) { frames_.push_back(std::move(frame)); }
  std::size_t frames() const { return frames_.size(); }

  /// The recording. `has_stamps` false: frames get the sensor's scan period between them.
  Recording finish(SensorModel sensor, bool has_stamps);

 private:
  const LogOptions& options_;
  Pose2 robot_from_sensor_;
  std::vector<Frame> frames_;
  long long scans_ = 0;
  std::size_t beams_ = 0;
  int beams_line_ = 0;
  bool has_angles_ = false;
  BeamAngles angles_{0.0, 0.0};
};

}  // namespace scanbench::harness
