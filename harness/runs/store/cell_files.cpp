// Writes and reads the files of a cell: results of a pipeline, status.json and metrics.csv.
#include "harness/runs/store/cell_files.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/index.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/files/npy.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/study/catalog/chain.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Columns = std::vector<std::string>;

const Columns kLineColumns{"frame", "line",      "x1_m",       "y1_m",      "x2_m",   "y2_m",
                           "rho_m", "alpha_rad", "first_beam", "last_beam", "points", "rms_m"};
const Columns kMapColumns{"line", "x1_m", "y1_m", "x2_m", "y2_m", "members", "points"};
const Columns kPoseColumns{"frame", "x_m", "y_m", "yaw_rad"};
const Columns kMergeColumns{"frame", "line", "cluster1", "cluster2", "map_line"};
const Columns kMatchColumns{"frame",     "reference",  "x_m",       "y_m",        "yaw_rad",      "cov_xx_m2",
                            "cov_xy_m2", "cov_xyaw_m", "cov_yy_m2", "cov_yyaw_m", "cov_yaw_rad2", "status"};
const Columns kTimingColumns{"stage", "frame", "seconds"};
const Columns kMetricColumns{"metric", "subject", "value", "unit", "count", "ci_low", "ci_high"};
const Columns kCovarianceColumns{"cov_offset_m2", "cov_offset_angle", "cov_angle_rad2"};

Columns with_covariance(Columns columns, bool wanted) {
  if (wanted) columns.insert(columns.end(), kCovarianceColumns.begin(), kCovarianceColumns.end());
  return columns;
}

void segment_fields(io::CsvWriter& csv, const Segment& s) {
  csv.number(s.a.x()).number(s.a.y()).number(s.b.x()).number(s.b.y());
}

Segment segment_from(const io::CsvTable& csv, std::size_t row) {
  return {{csv.number(row, "x1_m"), csv.number(row, "y1_m")}, {csv.number(row, "x2_m"), csv.number(row, "y2_m")}};
}

void covariance_fields(io::CsvWriter& csv, const Eigen::Matrix2d& c) {
  csv.number(c(0, 0)).number(c(0, 1)).number(c(1, 1));
}

std::optional<Eigen::Matrix2d> covariance_from(const io::CsvTable& csv, std::size_t row) {
  const auto offset = csv.optional_number(row, kCovarianceColumns[0]);
  if (!offset) return std::nullopt;
  Eigen::Matrix2d c;
  c(0, 0) = *offset;
  c(0, 1) = c(1, 0) = csv.number(row, kCovarianceColumns[1]);
  c(1, 1) = csv.number(row, kCovarianceColumns[2]);
  return c;
}

void write_lines(const fs::path& cell, const std::vector<ScanLines>& scans) {
  bool covariance = false;
  for (const auto& scan : scans)
    for (const auto& line : scan.lines) covariance = covariance || line.covariance.has_value();
  io::CsvWriter csv(with_covariance(kLineColumns, covariance));
  std::vector<std::int32_t> labels;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    labels.insert(labels.end(), scans[k].labels.begin(), scans[k].labels.end());
    for (std::size_t i = 0; i < scans[k].lines.size(); ++i) {
      const LineFeature& line = scans[k].lines[i];
      csv.integer(static_cast<long long>(k)).integer(static_cast<long long>(i));
      segment_fields(csv, line.segment);
      csv.number(line.line.rho).number(line.line.alpha);
      csv.integer(line.first_beam).integer(line.last_beam).integer(line.points).number(line.rms_m);
      if (covariance && line.covariance)
        covariance_fields(csv, *line.covariance);
      else if (covariance)
        csv.empty().empty().empty();
      csv.end_row();
    }
  }
  io::write_staged_file(cell / kLinesFile, csv.str());
  const std::size_t beams = scans.empty() ? 0 : scans.front().labels.size();
  io::write_staged_file(cell / kLabelsFile, io::npy_bytes(labels, scans.size(), beams));
}

/// Frames without beams occupy no bytes, so only this limit protects from a damaged header that states too many.
constexpr std::size_t kMostFramesWithoutBeams = 1000000;

std::vector<ScanLines> load_lines(const StoredFiles& cell) {
  const fs::path labels_file = cell.path(kLabelsFile);
  const auto labels = io::parse_npy_int32(cell.read(kLabelsFile), labels_file);
  if (labels.columns == 0 && labels.rows > kMostFramesWithoutBeams)
    throw ConfigError(labels_file.string() + ": " + std::to_string(labels.rows) +
                      " frames without beams; allowed: at most " + std::to_string(kMostFramesWithoutBeams));
  std::vector<ScanLines> scans(labels.rows);
  for (std::size_t k = 0; k < labels.rows; ++k) {
    const auto row = labels.values.begin() + static_cast<std::ptrdiff_t>(k * labels.columns);
    scans[k].labels.assign(row, row + static_cast<std::ptrdiff_t>(labels.columns));
  }
  const io::CsvTable csv = cell.table(kLinesFile, kLineColumns);
  const bool covariance = csv.has(kCovarianceColumns.front());
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const int frame = csv.index(r, "frame");
    if (frame < 0 || static_cast<std::size_t>(frame) >= scans.size())
      csv.refuse(r, "frame " + std::to_string(frame) + " is not in labels.npy");
    auto& lines = scans[static_cast<std::size_t>(frame)].lines;
    if (csv.index(r, "line") != static_cast<int>(lines.size())) csv.refuse(r, "lines must be numbered 0, 1, 2, ...");
    lines.push_back({.segment = segment_from(csv, r),
                     .line = {csv.number(r, "rho_m"), csv.number(r, "alpha_rad")},
                     .covariance = covariance ? covariance_from(csv, r) : std::nullopt,
                     .first_beam = csv.index(r, "first_beam"),
                     .last_beam = csv.index(r, "last_beam"),
                     .points = csv.index(r, "points"),
                     .rms_m = csv.number(r, "rms_m")});
  }
  for (std::size_t k = 0; k < scans.size(); ++k)
    for (const int label : scans[k].labels)
      if (label < -1 || label >= static_cast<int>(scans[k].lines.size()))
        throw ConfigError(labels_file.string() + ": frame " + std::to_string(k) + " has the label " +
                          std::to_string(label) + ", but lines.csv has " + std::to_string(scans[k].lines.size()) +
                          " lines of this frame");
  return scans;
}

void write_map(const fs::path& cell, const LineMap& map) {
  bool covariance = false;
  for (const auto& line : map.lines) covariance = covariance || !line.covariance.isZero(0.0);
  io::CsvWriter csv(with_covariance(kMapColumns, covariance));
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    csv.integer(static_cast<long long>(i));
    segment_fields(csv, map.lines[i].segment);
    csv.integer(map.lines[i].members).integer(map.lines[i].points);
    if (covariance) covariance_fields(csv, map.lines[i].covariance);
    csv.end_row();
  }
  io::write_staged_file(cell / kMapFile, csv.str());
}

void write_matches(const fs::path& file, const std::vector<FrameMatch>& matches) {
  io::CsvWriter csv(kMatchColumns);
  for (const auto& m : matches) {
    const Pose2& pose = m.match.reference_from_current;
    const Eigen::Matrix3d& c = m.match.covariance;
    csv.integer(m.frame).integer(m.reference).number(pose.x()).number(pose.y()).number(pose.yaw());
    csv.number(c(0, 0)).number(c(0, 1)).number(c(0, 2)).number(c(1, 1)).number(c(1, 2)).number(c(2, 2));
    csv.text(to_string(m.match.status)).end_row();
  }
  io::write_staged_file(file, csv.str());
}

Status status_from(const io::CsvTable& csv, std::size_t row) {
  const std::string text = csv.text(row, "status");
  for (const Status status : {Status::converged, Status::max_iterations, Status::degenerate, Status::no_match})
    if (to_string(status) == text) return status;
  csv.refuse(row, "no outcome of a match is called '" + text + "'");
}

std::vector<FrameMatch> load_matches(const StoredFiles& cell, const RunFile& file, std::size_t frames) {
  if (!cell.has(file)) return {};
  const io::CsvTable csv = cell.table(file, kMatchColumns);
  std::vector<FrameMatch> matches;
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    FrameMatch m{.frame = csv.index(r, "frame"), .reference = csv.index(r, "reference"), .match = {}};
    for (const int frame : {m.frame, m.reference})
      if (frame < 0 || static_cast<std::size_t>(frame) >= frames)
        csv.refuse(r, "frame " + std::to_string(frame) + " is not in labels.npy");
    m.match.status = status_from(csv, r);
    m.match.reference_from_current = {csv.number(r, "x_m"), csv.number(r, "y_m"), csv.number(r, "yaw_rad")};
    Eigen::Matrix3d& c = m.match.covariance;
    c(0, 0) = csv.number(r, "cov_xx_m2");
    c(0, 1) = c(1, 0) = csv.number(r, "cov_xy_m2");
    c(0, 2) = c(2, 0) = csv.number(r, "cov_xyaw_m");
    c(1, 1) = csv.number(r, "cov_yy_m2");
    c(1, 2) = c(2, 1) = csv.number(r, "cov_yyaw_m");
    c(2, 2) = csv.number(r, "cov_yaw_rad2");
    if (!m.match.reference_from_current.translation().allFinite() || !c.allFinite())
      csv.refuse(r, "the match is not finite");
    matches.push_back(m);
  }
  return matches;
}

}  // namespace

std::string status_json(const CellRecord& record) {
  const Json json{{"schema", 1},
                  {"status", to_string(record.outcome.status)},
                  {"message", record.outcome.message},
                  {"wall_seconds", record.outcome.wall_seconds},
                  {"cpu_seconds", record.outcome.cpu_seconds},
                  {"peak_memory_bytes", record.outcome.peak_memory_bytes},
                  {"address", record.address}};
  // Output of a module may not be valid UTF-8.
  return io::json_text(json) + "\n";
}

CellRecord load_status(const StoredFiles& cell) {
  return with_json_of(cell, kStatusFile, [&](const Json& json) -> CellRecord {
    try {
      return {{.status = cell_status_from(json.at("status").get<std::string>()),
               .message = json.at("message"),
               .wall_seconds = json.at("wall_seconds"),
               .cpu_seconds = json.at("cpu_seconds"),
               .peak_memory_bytes = json.at("peak_memory_bytes")},
              json.value("address", "")};
    } catch (const ConfigError& e) {
      throw ConfigError(cell.path(kStatusFile).string() + ": " + e.what());
    }
  });
}

void write_result(const fs::path& cell, const study::PipelineSpec& pipeline, const PipelineResult& result) {
  write_lines(cell, result.lines);
  if (!result.world_from_sensor.empty()) {
    io::CsvWriter csv(kPoseColumns);
    for (std::size_t k = 0; k < result.world_from_sensor.size(); ++k) {
      const Pose2& pose = result.world_from_sensor[k];
      csv.integer(static_cast<long long>(k)).number(pose.x()).number(pose.y()).number(pose.yaw()).end_row();
    }
    io::write_staged_file(cell / kPosesFile, csv.str());
  }
  if (study::has_slot(pipeline, "match")) write_matches(cell / kPoseMatchesFile, result.matches);
  if (!result.skip_matches.empty()) write_matches(cell / kSkipMatchesFile, result.skip_matches);
  if (result.has_map) write_map(cell, result.map);
  if (study::has_slot(pipeline, "merge")) {
    io::CsvWriter csv(kMergeColumns);
    for (const auto& l : result.merge_labels) {
      csv.integer(l.frame).integer(l.line).integer(l.cluster1).integer(l.cluster2).integer(l.map_line);
      csv.end_row();
    }
    io::write_staged_file(cell / kMergeFile, csv.str());
  }
  io::CsvWriter csv(kTimingColumns);
  for (const auto& time : result.times) csv.text(time.label()).integer(time.frame).number(time.seconds).end_row();
  io::write_staged_file(cell / kTimingFile, csv.str());
}

PipelineResult load_result(const StoredFiles& cell) {
  PipelineResult result;
  result.lines = load_lines(cell);
  if (cell.has(kPosesFile)) {
    const io::CsvTable csv = cell.table(kPosesFile, kPoseColumns);
    for (std::size_t r = 0; r < csv.rows(); ++r) {
      const Eigen::Vector3d p(csv.number(r, "x_m"), csv.number(r, "y_m"), csv.number(r, "yaw_rad"));
      if (!p.allFinite()) csv.refuse(r, "the pose is not finite");
      result.world_from_sensor.emplace_back(p.x(), p.y(), p.z());
    }
    if (csv.rows() != result.lines.size())
      throw ConfigError(cell.path(kPosesFile).string() + ": " + std::to_string(csv.rows()) + " poses for " +
                        std::to_string(result.lines.size()) + " frames");
  }
  result.matches = load_matches(cell, kPoseMatchesFile, result.lines.size());
  result.skip_matches = load_matches(cell, kSkipMatchesFile, result.lines.size());
  result.has_map = cell.has(kMapFile);
  if (result.has_map) {
    const io::CsvTable csv = cell.table(kMapFile, kMapColumns);
    const bool covariance = csv.has(kCovarianceColumns.front());
    for (std::size_t r = 0; r < csv.rows(); ++r) {
      MapLine line{
          .segment = segment_from(csv, r), .members = csv.index(r, "members"), .points = csv.index(r, "points")};
      if (covariance) line.covariance = covariance_from(csv, r).value_or(Eigen::Matrix2d::Zero());
      result.map.lines.push_back(line);
    }
  }
  if (cell.has(kMergeFile)) {
    const io::CsvTable csv = cell.table(kMergeFile, kMergeColumns);
    for (std::size_t r = 0; r < csv.rows(); ++r) {
      const MergeLabel label{csv.index(r, "frame"), csv.index(r, "line"), csv.index(r, "cluster1"),
                             csv.index(r, "cluster2"), csv.index(r, "map_line")};
      if (label.frame < 0 || as_index(label.frame) >= result.lines.size() || label.line < 0 ||
          as_index(label.line) >= result.lines[as_index(label.frame)].lines.size())
        csv.refuse(r, fmt::format("frame {} has no line {}", label.frame, label.line));
      if (label.map_line < -1 || (label.map_line >= 0 && as_index(label.map_line) >= result.map.lines.size()))
        csv.refuse(r, fmt::format("the map has no line {}; it has {}", label.map_line, result.map.lines.size()));
      result.merge_labels.push_back(label);
    }
  }
  if (cell.has(kTimingFile)) {
    const io::CsvTable csv = cell.table(kTimingFile, kTimingColumns);
    for (std::size_t r = 0; r < csv.rows(); ++r) {
      auto time = stage_time_labelled(csv.text(r, "stage"), csv.index(r, "frame"));
      if (!time) csv.refuse(r, io::quoted_excerpt(csv.text(r, "stage")) + " is not a stage");
      time->seconds = csv.number(r, "seconds");
      result.times.push_back(std::move(*time));
    }
  }
  return result;
}

double stage_seconds(const io::CsvTable& timing) {
  double sum = 0.0;
  for (std::size_t row = 0; row < timing.rows(); ++row) sum += timing.number(row, "seconds");
  return sum;
}

std::string metrics_csv(const std::vector<metrics::MetricRow>& rows) {
  io::CsvWriter csv(kMetricColumns);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& row : rows)
    csv.text(row.metric)
        .text(row.subject)
        .number(row.value)
        .text(row.unit)
        .integer(row.count)
        .number(row.ci_low.value_or(nan))
        .number(row.ci_high.value_or(nan))
        .end_row();
  return csv.str();
}

std::vector<metrics::MetricRow> load_metrics(const StoredFiles& cell) {
  const io::CsvTable csv = cell.table(kMetricsFile, kMetricColumns);
  std::vector<metrics::MetricRow> rows;
  for (std::size_t r = 0; r < csv.rows(); ++r)
    rows.push_back({csv.text(r, "metric"), csv.text(r, "subject"), csv.number(r, "value"), csv.text(r, "unit"),
                    csv.integer(r, "count"), csv.optional_number(r, "ci_low"), csv.optional_number(r, "ci_high")});
  return rows;
}

}  // namespace scanbench::runs
