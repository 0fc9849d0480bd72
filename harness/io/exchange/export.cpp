// Writers of the CARMEN, CSV and TUM formats.
#include "harness/io/exchange/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/placed_error.hpp"

namespace scanbench::io {
namespace {

constexpr std::string_view kColumns = "t_s, x_m, y_m, yaw_rad, ranges";

const Pose2& best_pose(const Recording& recording, std::size_t frame) {
  return recording.truth ? recording.truth->world_from_sensor[frame]
                         : recording.observed.frames[frame].odom_from_sensor;
}

// True if the beams begin at -90 deg and have the step that readers assume for FLASER.
bool has_flaser_angles(const ScanGeometry& geometry) {
  const int n = geometry.beams();
  double step = 0.0;
  if (n == 180 || n == 360) step = 180.0 / n;
  if (n == 181 || n == 361) step = 180.0 / (n - 1);
  constexpr double kTiny = 1e-12;
  return step != 0 && std::abs(geometry.angle_min() - radians(-90.0)) < kTiny &&
         std::abs(geometry.angle_step() - radians(step)) < kTiny;
}

// The value written for +inf: greater than every reading.
double no_return_value(const ScanSet& scans) {
  double greatest = 0.0;
  for (const auto& frame : scans.frames)
    for (const double r : frame.ranges)
      if (std::isfinite(r)) greatest = std::max(greatest, r);
  const double limit = scans.sensor.range_max_m;
  return greatest < limit ? limit : greatest + 1.0;
}

double carmen_reading(double range, const SensorModel& sensor, double no_return) {
  if (std::isnan(range)) return 0.0;
  if (std::isinf(range)) return range > 0 ? no_return : 0.5 * sensor.range_min_m;
  return range;
}

void add_pose(std::string& out, const Pose2& pose) {
  for (const double v : {pose.x(), pose.y(), pose.yaw()}) (out += ' ') += number_text(v);
}

std::string carmen_text(const Recording& recording) {
  const SensorModel& sensor = recording.observed.sensor;
  const ScanGeometry& geometry = sensor.geometry;
  const double no_return = no_return_value(recording.observed);
  const bool flaser = has_flaser_angles(geometry);
  std::string out = fmt::format("# scanbench export of {}; no_return_m {} range_min_m {}\n", sensor.name,
                                number_text(no_return), number_text(sensor.range_min_m));
  const std::string head = flaser ? "FLASER"
                                  : fmt::format("ROBOTLASER1 0 {} {} {} {} 0 0", number_text(geometry.angle_min()),
                                                number_text(geometry.angle_step() * std::max(geometry.beams() - 1, 0)),
                                                number_text(geometry.angle_step()), number_text(sensor.range_max_m));
  for (std::size_t i = 0; i < recording.observed.frames.size(); ++i) {
    const Frame& frame = recording.observed.frames[i];
    out += head;
    (out += ' ') += std::to_string(frame.ranges.size());
    for (const double r : frame.ranges) (out += ' ') += number_text(carmen_reading(r, sensor, no_return));
    if (!flaser) out += " 0";  // remissions
    add_pose(out, best_pose(recording, i));
    add_pose(out, frame.odom_from_sensor);
    if (!flaser) out += " 0 0 0 0 0";  // speeds, safety distances, turn axis
    const std::string stamp = number_text(frame.stamp_s);
    out += " " + stamp + " scanbench " + stamp + "\n";
  }
  return out;
}

std::string csv_text(const Recording& recording) {
  const ScanGeometry& geometry = recording.observed.sensor.geometry;
  std::string out = fmt::format("# scanbench export of {}; first_angle_deg {} step_deg {} columns [{}]\n",
                                recording.observed.sensor.name, number_text(degrees(geometry.angle_min())),
                                number_text(degrees(geometry.angle_step())), kColumns);
  for (const auto& frame : recording.observed.frames) {
    const Pose2& pose = frame.odom_from_sensor;
    out += number_text(frame.stamp_s);
    for (const double v : {pose.x(), pose.y(), pose.yaw()}) (out += ',') += number_text(v);
    for (const double r : frame.ranges) (out += ',') += std::isnan(r) ? "nan" : number_text(r);
    out += '\n';
  }
  return out;
}

std::string tum_poses(const Recording& recording) {
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < recording.observed.frames.size(); ++i)
    poses.push_back({recording.observed.frames[i].stamp_s, best_pose(recording, i)});
  return tum_text(poses);
}

[[noreturn]] void refuse_format(std::string_view format) {
  throw ConfigError("no export format is called '" + std::string(format) + "'" + known_names(format, export_formats()));
}

}  // namespace

std::vector<std::string> export_formats() {
  return {"carmen", "csv", "tum"};
}

std::string export_text(const Recording& recording, std::string_view format) {
  if (format != "tum" && recording.observed.has_given_lines())
    throw ConfigError("a recording of lines holds no scans to export as " + std::string(format) + "; allowed: tum");
  if (format == "carmen") return carmen_text(recording);
  if (format == "csv") return csv_text(recording);
  if (format == "tum") return tum_poses(recording);
  refuse_format(format);
}

ParamSet import_params(const Recording& recording, std::string_view format) {
  const SensorModel& sensor = recording.observed.sensor;
  if (format == "carmen")
    return {{"no_return_m", no_return_value(recording.observed)},
            {"range_min_m", sensor.range_min_m},
            {"poses", std::string("odometry")}};
  if (format == "csv") {
    ParamSet params{{"columns", std::string(kColumns)},
                    {"first_angle_deg", degrees(sensor.geometry.angle_min())},
                    {"step_deg", degrees(sensor.geometry.angle_step())},
                    {"range_min_m", sensor.range_min_m}};
    if (sensor.geometry.beams() == 1) params["beams"] = std::int64_t{1};  // a single beam has no step
    return params;
  }
  refuse_format(format);
}

std::string tum_text(const std::vector<StampedPose>& poses) {
  std::string out = "# timestamp tx ty tz qx qy qz qw\n";
  for (const auto& [stamp, pose] : poses) {
    const double half = 0.5 * pose.yaw();
    out += fmt::format("{} {} {} 0 0 0 {} {}\n", number_text(stamp), number_text(pose.x()), number_text(pose.y()),
                       number_text(std::sin(half)), number_text(std::cos(half)));
  }
  return out;
}

}  // namespace scanbench::io
