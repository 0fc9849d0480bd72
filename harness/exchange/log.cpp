// Which format is which, and DP-SLAM's, the smallest.
#include "harness/exchange/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/exchange/log_builder.hpp"
#include "harness/exchange/log_carmen.hpp"
#include "harness/exchange/log_csv.hpp"
#include "harness/files/placed_error.hpp"
#include "harness/files/text_file.hpp"

namespace scanbench::harness {
namespace {

struct Format {
  std::string_view name;
  std::vector<std::string_view> options;
  Recording (*parse)(std::string_view, const LogOptions&, const SensorModel&);
};

const std::array<Format, 3>& formats() {
  static const std::array<Format, 3> all = {
      Format{"carmen",
             {"poses", "no_return_m", "range_min_m", "first_angle_deg", "step_deg", "every", "max_frames", "sensor_x_m",
              "sensor_y_m", "sensor_yaw_deg"},
             parse_carmen},
      Format{"csv",
             {"columns", "skip_lines", "beams", "unit_m", "no_return_m", "range_min_m", "first_angle_deg", "step_deg",
              "every", "max_frames", "sensor_x_m", "sensor_y_m", "sensor_yaw_deg"},
             parse_csv_scans},
      Format{"dpslam",
             {"no_return_m", "range_min_m", "first_angle_deg", "step_deg", "every", "max_frames", "sensor_x_m",
              "sensor_y_m", "sensor_yaw_deg"},
             parse_dpslam}};
  return all;
}

const Format& format_of(std::string_view name) {
  const auto it = std::ranges::find(formats(), name, &Format::name);
  if (it == formats().end())
    throw ConfigError(fmt::format("format is {}; allowed: {}", quoted_excerpt(name), fmt::join(log_formats(), ", ")));
  return *it;
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

Recording parse_dpslam(std::string_view text, const LogOptions& options, const SensorModel& sensor) {
  LogLines lines(text);
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
        lines.refuse(words[0], "a Laser line without an Odometry line before it; allowed: the two in turns");
      lines.check_last_number(words);
      builder.check_beams(lines, n);
      builder.check_angles(lines, builder.angles_by_rule(lines, n));
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

Recording parse_log(std::string_view text, const std::string& file, std::string_view format, const ParamSet& params,
                    const SensorModel& sensor) {
  const Format& f = format_of(format);
  const auto options = make_params<LogOptions>(resolve(log_param_specs(format), params));
  return in_file(file, {}, [&] { return f.parse(text, options, sensor); });
}

Recording read_log(const std::filesystem::path& path, std::string_view format, const ParamSet& params,
                   const SensorModel& sensor, double max_bytes) {
  format_of(format);
  const std::string text = read_text_file(path, static_cast<std::uint64_t>(std::clamp(max_bytes, 0.0, 1e18)));
  // A number takes at least two characters of the text; most scans are near that.
  const auto separators = static_cast<double>(
      std::ranges::count_if(text, [](char c) { return c == ' ' || c == ',' || c == '\n' || c == '\t'; }));
  const double needed = static_cast<double>(text.size()) + 8.0 * separators;
  if (needed > max_bytes)
    throw ConfigError(
        fmt::format("{}: needs about {} (text {} + {:.0f} numbers x 8 B); allowed: {}; take fewer scans, or raise "
                    "limits.memory_mib",
                    path.string(), size_text(needed), size_text(static_cast<double>(text.size())), separators,
                    size_text(max_bytes)));
  return parse_log(text, path.string(), format, params, sensor);
}

}  // namespace scanbench::harness
