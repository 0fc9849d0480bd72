// Builds calls and reads answers.
#include "harness/study/foreign/call.hpp"

#include <fmt/format.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/json.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/hello.hpp"

namespace scanbench::study {
namespace {

constexpr double kStartSeconds = 60.0;      // for an interpreter to load its libraries
constexpr double kNoLimit = 365 * 86400.0;  // the limit of the cell ends it before

bool same_noise(const SensorNoise& a, const SensorNoise& b) {
  return a.sigma_m == b.sigma_m && a.sigma_relative == b.sigma_relative && a.relative_from_m == b.relative_from_m &&
         a.bearing_sigma_rad == b.bearing_sigma_rad && a.quantum_m == b.quantum_m &&
         a.dropout_probability == b.dropout_probability && a.dropout_grazing == b.dropout_grazing &&
         a.spurious_probability == b.spurious_probability && a.beam_divergence_rad == b.beam_divergence_rad;
}

bool same_sheet(const SensorModel& a, const SensorModel& b) {
  const ScanGeometry& f = a.geometry;
  const ScanGeometry& g = b.geometry;
  return f.beams() == g.beams() && f.angle_min() == g.angle_min() && f.angle_step() == g.angle_step() &&
         a.range_min_m == b.range_min_m && a.range_max_m == b.range_max_m && a.time_per_beam_s == b.time_per_beam_s &&
         a.scan_period_s == b.scan_period_s && a.name == b.name && same_noise(a.noise, b.noise);
}

nlohmann::json data_sheet(const SensorModel& sensor) {
  const SensorNoise& noise = sensor.noise;
  return {{"name", sensor.name},
          {"beams", sensor.geometry.beams()},
          {"angle_min_rad", sensor.geometry.angle_min()},
          {"angle_step_rad", sensor.geometry.angle_step()},
          {"range_min_m", sensor.range_min_m},
          {"range_max_m", sensor.range_max_m},
          {"time_per_beam_s", sensor.time_per_beam_s},
          {"scan_period_s", sensor.scan_period_s},
          {"sigma_m", noise.sigma_m},
          {"sigma_relative", noise.sigma_relative},
          {"relative_from_m", noise.relative_from_m},
          {"bearing_sigma_rad", noise.bearing_sigma_rad},
          {"quantum_m", noise.quantum_m},
          {"dropout_probability", noise.dropout_probability},
          {"dropout_grazing", noise.dropout_grazing},
          {"spurious_probability", noise.spurious_probability},
          {"beam_divergence_rad", noise.beam_divergence_rad}};
}

Eigen::Matrix2d symmetric(double a, double b, double c) {
  Eigen::Matrix2d matrix;
  matrix << a, b, b, c;
  return matrix;
}

}  // namespace

Call::Call(std::string_view name) : header_(fmt::format("{{\"call\":\"{}\"", name)) {}

Call& Call::view(std::string_view name, std::span<const double> numbers) {
  arrays_ += fmt::format("{}[\"{}\",{}]", arrays_.empty() ? "" : ",", name, numbers.size());
  parts_.push_back(numbers);
  return *this;
}

Call& Call::own(std::string_view name, std::vector<double> numbers) {
  owned_.push_back(std::move(numbers));
  return view(name, owned_.back());
}

Call& Call::key(std::string_view name, const nlohmann::json& value) {
  header_ += fmt::format(",\"{}\":{}", name, io::json_line(value));
  return *this;
}

Call& Call::scan(std::string_view prefix, const Scan& scan) {
  view(std::string(prefix) + "ranges", scan.ranges);
  return own(std::string(prefix) + "stamp_s", {scan.stamp_s});
}

Call& Call::lines(std::string_view prefix, const ScanLines& lines) {
  own(std::string(prefix) + "lines", to_rows(lines.lines));
  own(std::string(prefix) + "covariances", covariance_rows(lines.lines));
  return own(std::string(prefix) + "labels", {lines.labels.begin(), lines.labels.end()});
}

std::string Call::header() const {
  return header_ + (arrays_.empty() ? "" : ",\"arrays\":[" + arrays_ + "]");
}

std::vector<double> to_rows(std::span<const LineFeature> lines) {
  std::vector<double> rows;
  rows.reserve(lines.size() * kLineColumns);
  for (const LineFeature& l : lines)
    rows.insert(rows.end(), {l.segment.a.x(), l.segment.a.y(), l.segment.b.x(), l.segment.b.y(), l.line.rho,
                             l.line.alpha, static_cast<double>(l.first_beam), static_cast<double>(l.last_beam),
                             static_cast<double>(l.points), l.rms_m});
  return rows;
}

std::vector<double> covariance_rows(std::span<const LineFeature> lines) {
  std::vector<double> rows;
  for (const LineFeature& l : lines) {
    const Eigen::Matrix2d c = l.covariance.value_or(Eigen::Matrix2d::Constant(kNaN));
    rows.insert(rows.end(), {c(0, 0), c(0, 1), c(1, 1)});
  }
  return rows;
}

std::vector<double> to_rows(std::span<const Pose2> poses) {
  std::vector<double> rows;
  for (const Pose2& p : poses) rows.insert(rows.end(), {p.x(), p.y(), p.cos(), p.sin()});
  return rows;
}

std::vector<double> to_rows(std::span<const MapLine> lines) {
  std::vector<double> rows;
  for (const MapLine& l : lines)
    rows.insert(rows.end(), {l.segment.a.x(), l.segment.a.y(), l.segment.b.x(), l.segment.b.y(), l.covariance(0, 0),
                             l.covariance(0, 1), l.covariance(1, 1), static_cast<double>(l.members),
                             static_cast<double>(l.points)});
  return rows;
}

ScanLines scan_lines_of(const Answer& answer) {
  ScanLines result;
  const std::span<const double> rows = answer.rows("lines", kLineColumns);
  const std::size_t count = rows.size() / kLineColumns;
  std::span<const double> covariances;
  if (answer.has("covariances")) covariances = answer.rows("covariances", kCovarianceColumns);
  if (!covariances.empty() && covariances.size() != count * kCovarianceColumns)
    throw InvalidResult(fmt::format("{} covariances for {} lines", covariances.size() / kCovarianceColumns, count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const double> row = rows.subspan(i * kLineColumns, kLineColumns);
    LineFeature line;
    line.segment = {{row[0], row[1]}, {row[2], row[3]}};
    line.line = {row[4], row[5]};
    line.first_beam = whole(row[6], "first_beam");
    line.last_beam = whole(row[7], "last_beam");
    line.points = whole(row[8], "points");
    line.rms_m = row[9];
    if (!covariances.empty()) {
      const std::span<const double> c = covariances.subspan(i * kCovarianceColumns, kCovarianceColumns);
      const bool absent = std::isnan(c[0]) && std::isnan(c[1]) && std::isnan(c[2]);
      if (!absent) line.covariance = symmetric(c[0], c[1], c[2]);
    }
    result.lines.push_back(line);
  }
  result.labels = answer.integers("labels");
  return result;
}

std::vector<Pose2> poses_of(const Answer& answer, const std::string& name) {
  const std::span<const double> rows = answer.rows(name, kPoseColumns);
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < rows.size(); i += kPoseColumns) {
    const double norm = std::hypot(rows[i + 2], rows[i + 3]);
    if (!(std::fabs(norm - 1.0) < 1e-6))
      throw InvalidResult(fmt::format("`{}` has a rotation (cos, sin) = ({}, {}) that has not the length 1", name,
                                      rows[i + 2], rows[i + 3]));
    poses.push_back(Pose2::from_unit({rows[i], rows[i + 1]}, {rows[i + 2], rows[i + 3]}));
  }
  return poses;
}

LineMap map_of(const Answer& answer) {
  LineMap map;
  const std::span<const double> rows = answer.rows("map", kMapColumns);
  for (std::size_t i = 0; i < rows.size(); i += kMapColumns) {
    const std::span<const double> row = rows.subspan(i, kMapColumns);
    map.lines.push_back({.segment = {{row[0], row[1]}, {row[2], row[3]}},
                         .covariance = symmetric(row[4], row[5], row[6]),
                         .members = whole(row[7], "members"),
                         .points = whole(row[8], "points")});
  }
  return map;
}

Status status_of(const Answer& answer) {
  const std::string text = answer.text("status");
  for (const Status status : {Status::converged, Status::max_iterations, Status::degenerate, Status::no_match})
    if (to_string(status) == text) return status;
  throw InvalidResult("the status is '" + text + "'; allowed: converged, max_iterations, degenerate, no_match");
}

Session::Session(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
    : program_(source, setting, ProgramOutput::inherited), scan_seconds_(source.scan_seconds) {
  const Call hello = Call("hello").key("scanbench", kProtocolVersion);
  const ForeignModule module = read_hello(program_.call(hello.header(), {}, kStartSeconds).header());
  if (module.kind != source.module.kind || module.info.name != source.module.info.name ||
      module.version != source.module.version)
    throw ForeignFault(fmt::format("the program `{}` is now {} {} {}; it was {} {} {} when the run was planned",
                                   source.text(), module.kind, module.info.name, module.version, source.module.kind,
                                   source.module.info.name, source.module.version));
  program_.call(Call("make").key("params", to_json(params)).header(), {}, kStartSeconds);
}

Answer Session::send(Call call, const SensorModel* sensor, int scans) {
  if (sensor != nullptr && !(told_ && same_sheet(*told_, *sensor))) {
    call.key("sensor", data_sheet(*sensor));
    told_ = *sensor;
  }
  return program_.call(call.header(), call.parts(), scans > 0 ? scans * scan_seconds_ : kNoLimit);
}

}  // namespace scanbench::study
