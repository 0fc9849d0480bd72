// Reads logs of one scan per row, whose fields `columns` names.
#include "harness/io/exchange/log_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/number_text.hpp"
#include "harness/io/exchange/log_builder.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

enum class Field { skip, time, x, y, yaw, ranges };

struct Column {
  Field field;
  double unit;  // in s, m, rad
};

struct ColumnName {
  std::string_view name;
  Column column;
};

constexpr std::array kColumnNames = {ColumnName{"t_s", {Field::time, 1.0}},
                                     ColumnName{"t_ms", {Field::time, 1e-3}},
                                     ColumnName{"t_us", {Field::time, 1e-6}},
                                     ColumnName{"x_m", {Field::x, 1.0}},
                                     ColumnName{"x_cm", {Field::x, 1e-2}},
                                     ColumnName{"x_mm", {Field::x, 1e-3}},
                                     ColumnName{"y_m", {Field::y, 1.0}},
                                     ColumnName{"y_cm", {Field::y, 1e-2}},
                                     ColumnName{"y_mm", {Field::y, 1e-3}},
                                     ColumnName{"yaw_rad", {Field::yaw, 1.0}},
                                     ColumnName{"yaw_deg", {Field::yaw, radians(1.0)}},
                                     ColumnName{"skip", {Field::skip, 1.0}},
                                     ColumnName{"ranges", {Field::ranges, 1.0}}};

struct Layout {
  std::vector<Column> columns;
  std::size_t ranges_at = 0;
  bool has_time = false;
};

void add_column(std::string_view word, Layout& layout) {
  // skip:20 means skip, 20 times.
  const std::size_t colon = word.find(':');
  const std::string_view name = word.substr(0, colon);
  long long times = 1;
  if (colon != std::string_view::npos) {
    const auto n = parse_integer(word.substr(colon + 1));
    if (name != "skip" || !n || *n < 1 || *n > 100000)
      throw ParamError("columns",
                       fmt::format("columns has {}; allowed: skip:n with n from 1 to 100000", quoted_excerpt(word)));
    times = *n;
  }
  for (const auto& known : kColumnNames) {
    if (known.name != name) continue;
    if (known.column.field != Field::skip)
      for (const auto& column : layout.columns)
        if (column.field == known.column.field)
          throw ParamError("columns", fmt::format("columns has {} a second time", name));
    if (known.column.field == Field::ranges) layout.ranges_at = layout.columns.size();
    if (known.column.field == Field::time) layout.has_time = true;
    layout.columns.insert(layout.columns.end(), static_cast<std::size_t>(times), known.column);
    return;
  }
  std::vector<std::string> names;
  names.reserve(std::size(kColumnNames));
  for (const auto& known : kColumnNames) names.emplace_back(known.name);
  const std::string near = nearest_name(name, names);
  throw ParamError("columns", fmt::format("columns has {}; {}allowed: {}", quoted_excerpt(word),
                                          near.empty() ? "" : "did you mean '" + near + "'? ", fmt::join(names, ", ")));
}

Layout parse_columns(const std::string& text) {
  Layout layout;
  std::vector<std::string_view> words;
  split_fields(text, words);
  bool has_ranges = false;
  for (const auto word : words) {
    add_column(word, layout);
    has_ranges |= word == "ranges";
  }
  if (!has_ranges) throw ParamError("columns", "columns has no 'ranges'; allowed: a list with one");
  return layout;
}

double range_of(const LogLines& lines, std::string_view word, double unit_m) {
  if (word == "inf" || word == "+inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  return unit_m * lines.number_of(word, "a range");
}

}  // namespace

void check_csv_options(const LogOptions& options) {
  parse_columns(options.columns);
  check_angle_options(options);
  if (options.step_deg == 0 && options.span_deg == 0 && options.beams != 1)
    throw ParamError("step_deg",
                     "step_deg is 0; allowed: the angle between two beams in deg, not 0 (or span_deg, or beams: 1)");
}

Recording parse_csv_scans(LogLines& lines, const LogOptions& options, const SensorModel& sensor) {
  const Layout layout = parse_columns(options.columns);
  const std::size_t others = layout.columns.size() - 1;
  LogBuilder builder(options);
  std::vector<std::string_view> fields;
  while (!builder.full() && lines.next()) {
    if (lines.number() <= options.skip_lines) continue;
    split_fields(lines.line().substr(0, lines.line().find('#')), fields);
    if (fields.empty()) continue;
    if (fields.size() <= others)
      lines.refuse(fields.front(),
                   fmt::format("a row of {} fields; allowed: at least {} ({} before and after the ranges)",
                               fields.size(), others + 1, others));
    const std::size_t n = fields.size() - others;
    if (options.beams > 0 && n != static_cast<std::size_t>(options.beams))
      lines.refuse(fields.front(), fmt::format("a row with {} ranges; allowed: beams = {}", n, options.beams));
    if (others == 0 && n == 4 && options.beams != 4)
      lines.refuse(
          fields.front(),
          "a row of four numbers: a vector map (x1, y1, x2, y2)? allowed: world: {file: PATH} for a vector map, "
          "or beams: 4 for scans of four beams");
    lines.check_last_number(fields);
    builder.begin_scan(lines, n,
                       builder.states_angles() ? builder.angles_by_rule(lines, n)
                                               : BeamAngles{options.first_angle_deg, 0.0});  // a single beam
    if (!builder.wants_scan()) continue;
    Frame frame;
    double x = 0.0;
    double y = 0.0;
    double yaw = 0.0;
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
      const Column& column = layout.columns[c];
      if (column.field == Field::skip || column.field == Field::ranges) continue;
      const std::string_view word = fields[c < layout.ranges_at ? c : c + n - 1];
      const double value = column.unit * lines.number_of(word, "a field");
      (column.field == Field::time ? frame.stamp_s
       : column.field == Field::x  ? x
       : column.field == Field::y  ? y
                                   : yaw) = value;
    }
    frame.ranges.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
      frame.ranges.push_back(builder.reading(range_of(lines, fields[layout.ranges_at + i], options.unit_m)));
    frame.odom_from_sensor = builder.pose(lines, x, y, yaw);
    builder.add(std::move(frame));
  }
  if (builder.frames() == 0)
    throw PlacedError({1, 1}, fmt::format("no row with a scan in {} lines; allowed: rows of numbers", lines.number()));
  return builder.finish(sensor, layout.has_time);
}

}  // namespace scanbench::io
