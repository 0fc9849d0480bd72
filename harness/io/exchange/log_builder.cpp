// Checks lines, angles, poses and readings by the rules that all log formats share.
#include "harness/io/exchange/log_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/number_text.hpp"

namespace scanbench::io {

/// Reads on until `rest_` has a line break or the file ends.
void LogLines::read_line() {
  std::size_t searched = 0;
  while (blocks_ != nullptr && rest_.find('\n', searched) == std::string_view::npos) {
    searched = rest_.size();
    const std::string_view block = blocks_->next();
    if (block.empty()) blocks_ = nullptr;
    held_.erase(0, held_.size() - rest_.size());
    held_ += block;
    rest_ = held_;
  }
}

bool LogLines::next() {
  read_line();
  if (rest_.empty()) return false;
  ends_open_ = rest_.find('\n') == std::string_view::npos;
  line_ = take_line(rest_);
  ++number_;
  return true;
}

void LogLines::refuse(std::string_view word, const std::string& message) const {
  throw PlacedError({number_, column_of(line_, word)},
                    message + (cut_short() ? "; the file ends in this line: is it cut short?" : ""));
}

void LogLines::check_last_number(const std::vector<std::string_view>& words) const {
  constexpr std::size_t kWitnesses = 32;
  if (!cut_short() || words.size() <= kWitnesses) return;
  const auto decimals = [](std::string_view word) {
    const std::size_t point = word.find('.');
    return point == std::string_view::npos ? 0 : word.size() - point - 1;
  };
  const auto before = std::span(words).last(kWitnesses + 1).first(kWitnesses);
  const std::size_t usual = decimals(before.front());
  if (decimals(words.back()) >= usual) return;
  if (!std::ranges::all_of(before, [&](std::string_view word) { return decimals(word) == usual; })) return;
  refuse(words.back(),
         fmt::format("{} has fewer than the {} decimals of the numbers before it; allowed: as many decimals, "
                     "or a line break after a complete number",
                     quoted_excerpt(words.back()), usual));
}

double LogLines::number_of(std::string_view word, std::string_view what) const {
  const auto number = parse_number(word);
  if (!number) refuse(word, fmt::format("{} is {}; allowed: a number", what, quoted_excerpt(word)));
  return *number;
}

LogBuilder::LogBuilder(const LogOptions& options)
    : options_(options), robot_from_sensor_(options.robot_from_sensor()) {}

bool LogBuilder::wants_scan() {
  return scans_++ % options_.every == 0;
}

bool LogBuilder::full() const {
  return options_.max_frames > 0 && frames_.size() >= static_cast<std::size_t>(options_.max_frames);
}

void check_angle_options(const LogOptions& options) {
  if (options.step_deg != 0 && options.span_deg != 0)
    throw ParamError("span_deg", "both step_deg and span_deg are given; allowed: one of them");
}

BeamAngles LogBuilder::angles_by_rule(const LogLines& lines, std::size_t beams) const {
  const auto n = static_cast<double>(beams);
  if (options_.step_deg != 0) return {options_.first_angle_deg, options_.step_deg};
  if (options_.span_deg != 0) return {options_.first_angle_deg, options_.span_deg / n};
  if (beams == 180 || beams == 360) return {-90.0, 180.0 / n};
  if (beams == 181 || beams == 361) return {-90.0, 180.0 / (n - 1.0)};
  lines.refuse(lines.line(),
               fmt::format("a scan of {} ranges without beam angles; allowed: 180, 181, 360 or 361 ranges, or "
                           "first_angle_deg and step_deg or span_deg given",
                           beams));
}

void LogBuilder::begin_scan(const LogLines& lines, std::size_t beams, const BeamAngles& angles) {
  current_ = {angles, beams};
  if (first_line_ == 0) {
    first_ = current_;
    first_line_ = lines.number();
  }
  if (options_.angles == LogAngles::same)
    check_same(lines);
  else
    check_size(lines);
}

void LogBuilder::check_same(const LogLines& lines) const {
  if (current_.count != first_.count)
    lines.refuse(lines.line(),
                 fmt::format("{} ranges, but the scan in line {} has {}; allowed: one number of ranges in a log, or "
                             "angles: resampled",
                             current_.count, first_line_, first_.count));
  if (current_.angles != first_.angles)
    lines.refuse(lines.line(),
                 fmt::format("beams from {} deg in steps of {} deg, but the scan in line {} has {} and {}; "
                             "allowed: one set of angles in a log, or angles: resampled",
                             current_.angles.first_deg, current_.angles.step_deg, first_line_, first_.angles.first_deg,
                             first_.angles.step_deg));
}

// Every scan gets as many beams as the first: a first scan of a million among many of ten would fill the memory.
void LogBuilder::check_size(const LogLines& lines) {
  constexpr double kMostEmpty = 4.0;
  constexpr double kAlwaysAllowed = 1e7;
  readings_ += static_cast<double>(current_.count);
  most_beams_ = std::max(most_beams_, current_.count);
  const double cells = static_cast<double>(++begun_) * static_cast<double>(most_beams_);
  if (cells > kAlwaysAllowed && cells > kMostEmpty * readings_)
    lines.refuse(lines.line(), fmt::format("a scan has {} beams, and {} scans have {:.0f} together; allowed: at most "
                                           "{} times the mean",
                                           most_beams_, begun_, readings_, kMostEmpty));
}

void LogBuilder::add(Frame frame) {
  if (current_ != first_) frame.ranges = resampled(frame.ranges);
  frames_.push_back(std::move(frame));
}

// Nothing is interpolated: between two beams may be the edge of a thing, where no point is.
std::vector<double> LogBuilder::resampled(const std::vector<double>& ranges) const {
  std::vector<double> result(first_.count, std::numeric_limits<double>::quiet_NaN());
  const BeamAngles& from = current_.angles;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double angle = first_.angles.first_deg + static_cast<double>(i) * first_.angles.step_deg;
    for (const double turn : {0.0, 360.0, -360.0}) {
      const double offset = angle + turn - from.first_deg;
      const double beam = from.step_deg != 0 ? std::round(offset / from.step_deg) : 0.0;
      const bool exists = beam >= 0 && beam < static_cast<double>(ranges.size());
      if (!exists || std::abs(offset - beam * from.step_deg) > std::abs(0.5 * from.step_deg) + 1e-9) continue;
      result[i] = ranges[static_cast<std::size_t>(beam)];
      break;
    }
  }
  return result;
}

Pose2 LogBuilder::pose(const LogLines& lines, double x_m, double y_m, double yaw_rad) const {
  constexpr double kLargestYaw = 1e5;  // beyond it sine and cosine have no meaning, and portable::sincos gives NaN
  if (std::abs(yaw_rad) > kLargestYaw)
    lines.refuse(lines.line(), fmt::format("a heading of {} rad; allowed: up to 1e5 rad", yaw_rad));
  const Pose2 world_from_robot(x_m, y_m, yaw_rad);
  return robot_from_sensor_ == Pose2() ? world_from_robot : world_from_robot * robot_from_sensor_;
}

double LogBuilder::reading(double range_m) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (range_m == -kInfinity) return range_m;
  if (!(range_m > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (range_m < options_.range_min_m) return -kInfinity;
  return options_.no_return_m > 0 && range_m >= options_.no_return_m ? kInfinity : range_m;
}

Recording LogBuilder::finish(SensorModel sensor, bool has_stamps) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (!has_stamps) frames_[i].stamp_s = static_cast<double>(i) * sensor.scan_period_s * options_.every;
    for (const double r : frames_[i].ranges)
      if (std::isfinite(r)) greatest = std::max(greatest, r);
  }
  sensor.range_min_m = options_.range_min_m;
  sensor.range_max_m = options_.no_return_m > 0 ? options_.no_return_m : std::max(sensor.range_max_m, greatest);
  sensor.geometry =
      ScanGeometry(radians(first_.angles.first_deg), radians(first_.angles.step_deg), static_cast<int>(first_.count));
  Recording recording;
  recording.observed.sensor = std::move(sensor);
  recording.observed.frames = std::move(frames_);
  if (!references_.empty()) recording.reference = ReferencePoses{std::move(references_), {}};
  return recording;
}

}  // namespace scanbench::io
