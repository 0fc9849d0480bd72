// Shared parts of the log readers: options, numbered lines, and the builder that adds frame by frame to a recording.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/geometry/pose2.hpp"
#include "core/params.hpp"
#include "core/recording.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {

enum class LogPoses { reference, odometry, vertex, none };

/// What to do with scans of other beam angles, or another number of beams, than the first.
enum class LogAngles {
  same,      ///< refuse them
  resampled  ///< each beam of the first scan's angles gets the reading of the nearest beam
};

/// Options of all formats; log_param_specs() names those of each.
struct LogOptions {
  LogPoses poses = LogPoses::reference;
  LogPoses compare_poses = LogPoses::none;
  double no_return_m = 0.0;
  double range_min_m = 0.0;
  double first_angle_deg = -90.0;
  double step_deg = 0.0;
  double span_deg = 0.0;
  LogAngles angles = LogAngles::same;
  std::string columns = "ranges";
  int skip_lines = 0;
  int beams = 0;
  double unit_m = 1.0;
  int every = 1;
  int max_frames = 0;
  double sensor_x_m = 0.0;
  double sensor_y_m = 0.0;
  double sensor_yaw_deg = 0.0;

  Pose2 robot_from_sensor() const { return {sensor_x_m, sensor_y_m, radians(sensor_yaw_deg)}; }
  static auto fields() {
    using O = LogOptions;
    return std::tuple{
        choice("poses", &O::poses,
               {{LogPoses::reference, "reference"},
                {LogPoses::odometry, "odometry"},
                {LogPoses::vertex, "vertex"},
                {LogPoses::none, "none"}},
               "pose of a scan: reference is the first triple of its line, odometry the second, vertex the VERTEX2 "
               "line before it; none: no odometry"),
        choice(
            "compare_poses", &O::compare_poses,
            {{LogPoses::none, "none"},
             {LogPoses::reference, "reference"},
             {LogPoses::odometry, "odometry"},
             {LogPoses::vertex, "vertex"}},
            "poses, named in the same way, that no algorithm sees and estimates are compared with (metric trajectory)"),
        field("no_return_m", &O::no_return_m, at_least(0), "m",
              "readings of this value or more mean nothing in range; 0 disables this"),
        field("range_min_m", &O::range_min_m, at_least(0), "m", "readings below this are too close"),
        field("first_angle_deg", &O::first_angle_deg, between(-360, 360), "deg",
              "angle of beam 0, counter-clockwise from straight ahead; used only with step_deg or span_deg"),
        field("step_deg", &O::step_deg, between(-360, 360), "deg",
              "angle from one beam to the next; 0 uses the angles of the format"),
        field(
            "span_deg", &O::span_deg, between(-360, 360), "deg",
            "angle that a scan's beams divide equally, from beam 0 to one step beyond the last; in place of step_deg, "
            "for scanners whose number of beams changes: 360 for a full turn; 0 disables it"),
        choice("angles", &O::angles, {{LogAngles::same, "same"}, {LogAngles::resampled, "resampled"}},
               "scans of other angles or another number of beams than the first: same refuses them, resampled gives "
               "each beam of the first scan the reading of the nearest beam"),
        field("columns", &O::columns,
              "columns of a row: t_s t_ms t_us x_m x_cm x_mm y_m y_cm y_mm yaw_rad yaw_deg skip skip:20 ranges"),
        field("skip_lines", &O::skip_lines, between(0, 1e6), "", "lines to skip at the top"),
        field("beams", &O::beams, between(0, 1e6), "", "number of ranges in a row; 0 allows any number"),
        field("unit_m", &O::unit_m, above(0), "m", "metres per unit of the ranges"),
        field("every", &O::every, between(1, 1e6), "", "read every n-th scan"),
        field("max_frames", &O::max_frames, between(0, 1e9), "", "number of scans to read; 0: all"),
        field("sensor_x_m", &O::sensor_x_m, any_number(), "m", "x of the sensor in the frame of the log's poses"),
        field("sensor_y_m", &O::sensor_y_m, any_number(), "m", "y of the sensor in that frame"),
        field("sensor_yaw_deg", &O::sensor_yaw_deg, between(-360, 360), "deg", "heading of the sensor in that frame")};
  }
};

/// The lines of a log, one at a time, with their numbers for messages. A line is valid until the next one is read.
class LogLines {
 public:
  explicit LogLines(std::string_view text) : rest_(text) {}
  /// Of a file, of which no more than a line and a block are held. `blocks` must remain.
  explicit LogLines(TextBlocks& blocks) : blocks_(&blocks) {}
  LogLines(const LogLines&) = delete;
  LogLines& operator=(const LogLines&) = delete;

  /// False at the end.
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }
  /// True if the file ends with this line and without a line break.
  bool cut_short() const { return ends_open_; }

  [[noreturn]] void refuse(std::string_view word, const std::string& message) const;
  /// Refuses a last line without line break whose last number has fewer decimals than the 32 numbers before it, which
  /// all have the same: the file was cut inside that number. The check cannot find a cut in whole numbers or in numbers
  /// of varying width.
  void check_last_number(const std::vector<std::string_view>& words) const;
  /// A finite number; throws PlacedError naming `what`.
  double number_of(std::string_view word, std::string_view what) const;

 private:
  void read_line();

  TextBlocks* blocks_ = nullptr;
  std::string held_;  ///< of a file: what was read and is not yet used
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
  bool ends_open_ = false;
};

/// Angle of the first beam, and from one beam to the next.
struct BeamAngles {
  double first_deg;
  double step_deg;
  bool operator==(const BeamAngles&) const = default;
};

/// Throws ParamError for both step_deg and span_deg.
void check_angle_options(const LogOptions& options);

class LogBuilder {
 public:
  explicit LogBuilder(const LogOptions& options);

  /// True if the next scan is read (`every`). Call it once per scan.
  bool wants_scan();
  /// True if the scans that `max_frames` allows are read.
  bool full() const;

  /// Do the options state beam angles, in place of those of the format?
  bool states_angles() const { return options_.step_deg != 0 || options_.span_deg != 0; }
  /// The angles that the options give, or else the rule for scanners of 180 degrees (log.hpp).
  BeamAngles angles_by_rule(const LogLines& lines, std::size_t beams) const;
  /// Takes note of the beams of the scan in this line, before add(). Throws PlacedError, naming both lines, if they
  /// differ from the first scan's and the options do not allow that.
  void begin_scan(const LogLines& lines, std::size_t beams, const BeamAngles& angles);

  /// The sensor's pose for a pose of the log (m, rad). Throws PlacedError for a heading above 1e5 rad.
  Pose2 pose(const LogLines& lines, double x_m, double y_m, double yaw_rad) const;

  /// A range in metres, with the special values of REP-117 (log.hpp).
  double reading(double range_m) const;

  /// Adds the scan that began last.
  void add(Frame frame);
  /// The pose that an estimate of the next frame is compared with: for every frame or for none.
  void add_reference(const Pose2& pose) { references_.push_back(pose); }
  std::size_t frames() const { return frames_.size(); }

  /// The recording. Without stamps in the log, frames are one scan period of the sensor apart.
  Recording finish(SensorModel sensor, bool has_stamps);

 private:
  struct Beams {
    BeamAngles angles{0.0, 0.0};
    std::size_t count = 0;
    bool operator==(const Beams&) const = default;
  };

  void check_same(const LogLines& lines) const;
  void check_size(const LogLines& lines);
  std::vector<double> resampled(const std::vector<double>& ranges) const;

  const LogOptions& options_;
  Pose2 robot_from_sensor_;
  std::vector<Frame> frames_;
  std::vector<Pose2> references_;
  long long scans_ = 0;
  Beams first_;    ///< of the scan in line first_line_
  Beams current_;  ///< of the scan that began last
  int first_line_ = 0;
  double readings_ = 0.0;  ///< of all scans so far
  std::size_t most_beams_ = 0;
  long long begun_ = 0;
};

}  // namespace scanbench::io
