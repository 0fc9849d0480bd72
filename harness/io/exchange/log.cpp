// The table of log formats, and the reader of DP-SLAM logs.
#include "harness/io/exchange/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/exchange/log_builder.hpp"
#include "harness/io/exchange/log_carmen.hpp"
#include "harness/io/exchange/log_csv.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

struct Format {
  std::string_view name;
  std::vector<std::string_view> options;
  Recording (*parse)(LogLines&, const LogOptions&, const SensorModel&);
  void (*check)(const LogOptions&);
  std::string_view summary;
  std::vector<std::string_view> notes;
};

constexpr std::string_view kAngleRule =
    "beam angles: first_angle_deg and step_deg (or span_deg / n) if one of them is given; else -90 deg + i * 180/n for "
    "n = 180 and 360 beams, -90 deg + i * 180/(n-1) for 181 and 361; other numbers of beams need step_deg or span_deg";
constexpr std::string_view kNoReturn =
    "the log does not state which readings mean that nothing is in range: no_return_m "
    "does, and must be given";

const std::array<Format, 3>& formats() {
  static const std::array<Format, 3> all = {
      Format{"carmen",
             {"poses", "compare_poses", "no_return_m", "range_min_m", "first_angle_deg", "step_deg", "span_deg",
              "angles", "every", "max_frames", "sensor_x_m", "sensor_y_m", "sensor_yaw_deg"},
             parse_carmen,
             check_angle_options,
             "CARMEN log: FLASER or ROBOTLASER1 lines",
             {kNoReturn, kAngleRule, "ROBOTLASER1 states its angles; step_deg or span_deg, if given, replaces them"}},
      Format{"csv",
             {"columns", "skip_lines", "beams", "unit_m", "no_return_m", "range_min_m", "first_angle_deg", "step_deg",
              "span_deg", "angles", "every", "max_frames", "sensor_x_m", "sensor_y_m", "sensor_yaw_deg"},
             parse_csv_scans,
             check_csv_options,
             "one scan per row of numbers",
             {"columns names the fields of a row in order; `ranges` must occur once and takes all fields that remain",
              "t_s, t_ms, t_us: stamp; without one, scans are the sensor's scan_period_s apart",
              "x_m, x_cm, x_mm, y_m, y_cm, y_mm, yaw_rad, yaw_deg: pose; a missing coordinate is 0",
              "skip: one ignored field; skip:20: 20 ignored fields",
              "inf, -inf and nan are allowed among the ranges: nothing in range, too close, no reading",
              "beam angles: first_angle_deg + i * step_deg, or + i * span_deg / n; one of them must be given unless "
              "beams is 1"}},
      Format{"dpslam",
             {"no_return_m", "range_min_m", "first_angle_deg", "step_deg", "span_deg", "angles", "every", "max_frames",
              "sensor_x_m", "sensor_y_m", "sensor_yaw_deg"},
             parse_dpslam,
             check_angle_options,
             "DP-SLAM log: Odometry and Laser lines alternate",
             {kNoReturn, kAngleRule}}};
  return all;
}

const Format& format_of(std::string_view name) {
  const auto it = std::ranges::find(formats(), name, &Format::name);
  if (it == formats().end())
    throw ConfigError(fmt::format("format is {}; allowed: {}", quoted_excerpt(name), fmt::join(log_formats(), ", ")));
  return *it;
}

constexpr std::string_view kAllowedLog = "a log in text, plain or gzip";

std::uint64_t byte_limit(double max_bytes) {
  return static_cast<std::uint64_t>(std::clamp(max_bytes, 0.0, 1e18));
}

/// Reads the log once without keeping it, so that a log that needs too much memory is refused before it takes any.
void check_size(const std::filesystem::path& path, double max_bytes) {
  constexpr std::size_t kMaxLineBytes = std::size_t{16} << 20;  // a scan of a million beams
  std::uint64_t numbers = 0;                                    // upper bound: the separators of words
  std::size_t line_bytes = 0;
  for_each_text_block(path, byte_limit(max_bytes), kAllowedLog, [&](std::string_view block) {
    const auto is_separator = [](char c) { return c == ' ' || c == ',' || c == '\n' || c == '\t'; };
    numbers += static_cast<std::uint64_t>(std::ranges::count_if(block, is_separator));
    // A block is smaller than the longest allowed line, so checking its last line break suffices.
    const std::size_t last_break = block.rfind('\n');
    line_bytes = last_break == std::string_view::npos ? line_bytes + block.size() : block.size() - last_break - 1;
    if (line_bytes > kMaxLineBytes)
      throw ConfigError(fmt::format("{}: a line longer than {}; allowed: {}", path.string(),
                                    size_text(static_cast<double>(kMaxLineBytes)), kAllowedLog));
  });
  if (const double needed = 8.0 * static_cast<double>(numbers); needed > max_bytes)
    throw ConfigError(
        fmt::format("{}: needs about {} ({} numbers x 8 B); allowed: {}; take fewer scans, or raise limits.memory_mib",
                    path.string(), size_text(needed), numbers, size_text(max_bytes)));
}

}  // namespace

std::vector<std::string> log_formats() {
  std::vector<std::string> names;
  for (const auto& format : formats()) names.emplace_back(format.name);
  return names;
}

std::vector<ParamSpec> log_param_specs(std::string_view format) {
  const Format& f = format_of(format);
  std::vector<ParamSpec> specs = param_specs<LogOptions>();
  std::erase_if(specs,
                [&](const ParamSpec& spec) { return std::ranges::find(f.options, spec.name) == f.options.end(); });
  return specs;
}

std::vector<std::string> required_log_params(std::string_view format) {
  const auto& notes = format_of(format).notes;
  if (std::ranges::count(notes, kNoReturn) == 0) return {};
  return {"no_return_m"};
}

void check_log_params(std::string_view format, const ParamSet& params) {
  format_of(format).check(make_params<LogOptions>(resolve(log_param_specs(format), params)));
}

Pose2 sensor_place(std::string_view format, const ParamSet& params) {
  return make_params<LogOptions>(resolve(log_param_specs(format), params)).robot_from_sensor();
}

LogFormatText log_format_text(std::string_view format) {
  const Format& f = format_of(format);
  return {std::string(f.summary), {f.notes.begin(), f.notes.end()}};
}

Recording parse_dpslam(LogLines& lines, const LogOptions& options, const SensorModel& sensor) {
  LogBuilder builder(options);
  std::vector<std::string_view> words;
  std::optional<Pose2> odometry;
  while (!builder.full() && lines.next()) {
    split_words(lines.line(), words);
    if (words.empty() || words[0].front() == '#') continue;
    if (words[0] == "Odometry") {
      if (words.size() != 4)
        lines.refuse(words[0], fmt::format("{} words in a line; allowed: Odometry x y yaw", words.size()));
      odometry = builder.pose(lines, lines.number_of(words[1], "x"), lines.number_of(words[2], "y"),
                              lines.number_of(words[3], "yaw"));
    } else if (words[0] == "Laser") {
      const std::size_t n = words.size() < 2 ? 0 : words.size() - 2;
      const auto stated = words.size() < 2 ? std::nullopt : parse_integer(words[1]);
      if (n == 0 || !stated || *stated < 0 || static_cast<std::size_t>(*stated) != n)
        lines.refuse(words[0], fmt::format("Laser states {} ranges and has {}; allowed: Laser n r1 .. rn",
                                           words.size() < 2 ? "no" : quoted_excerpt(words[1]), n));
      if (!odometry)
        lines.refuse(words[0],
                     "a Laser line without an Odometry line before it; allowed: Odometry and Laser lines alternate");
      lines.check_last_number(words);
      builder.begin_scan(lines, n, builder.angles_by_rule(lines, n));
      if (builder.wants_scan()) {
        Frame frame;
        frame.ranges.reserve(n);
        for (const auto word : std::span(words).subspan(2))
          frame.ranges.push_back(builder.reading(lines.number_of(word, "a range")));
        frame.odom_from_sensor = *odometry;
        builder.add(std::move(frame));
      }
      odometry.reset();
    } else {
      lines.refuse(words[0], fmt::format("a line that begins with {}; allowed: Odometry, Laser and # comments",
                                         quoted_excerpt(words[0])));
    }
  }
  if (builder.frames() == 0)
    throw PlacedError({1, 1},
                      fmt::format("no Laser line in {} lines; allowed: a DP-SLAM log with scans", lines.number()));
  return builder.finish(sensor, false);
}

namespace {

Recording parse_lines(LogLines& lines, const std::string& file, std::string_view format, const ParamSet& params,
                      const SensorModel& sensor) {
  const Format& f = format_of(format);
  const auto options = make_params<LogOptions>(resolve(log_param_specs(format), params));
  f.check(options);
  return in_file(file, {}, [&] { return f.parse(lines, options, sensor); });
}

}  // namespace

Recording parse_log(std::string_view text, const std::string& file, std::string_view format, const ParamSet& params,
                    const SensorModel& sensor) {
  LogLines lines(text);
  return parse_lines(lines, file, format, params, sensor);
}

Recording read_log(const std::filesystem::path& path, std::string_view format, const ParamSet& params,
                   const SensorModel& sensor, double max_bytes) {
  format_of(format);
  check_size(path, max_bytes);
  TextBlocks blocks(path, byte_limit(max_bytes), kAllowedLog);
  LogLines lines(blocks);
  return parse_lines(lines, path.string(), format, params, sensor);
}

}  // namespace scanbench::io
