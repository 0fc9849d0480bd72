// Writes and reads the files of a recording, and computes their content hash.
#include "harness/runs/store/recording_folder.hpp"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/files/npy.hpp"
#include "harness/runs/store/json_file.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Files = std::vector<std::pair<std::string, std::string>>;

const RunFile kFramesFile("recordings/*/*/frames.csv");
const RunFile kRotationsFile("recordings/*/*/rotations.npy");
const RunFile kGivenLinesFile("recordings/*/*/lines.csv");
const RunFile kReferencePosesFile("recordings/*/*/reference_poses.csv");
const RunFile kRelationsFile("recordings/*/*/relations.csv");
const RunFile kWallsFile("recordings/*/*/walls.csv");
const RunFile kWallIdsFile("recordings/*/*/wall_ids.npy");

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Numbers of a sensor in scan.json, by key.
struct SensorNumber {
  const char* key;
  double SensorModel::*member;
};
constexpr SensorNumber kSensorNumbers[] = {{"range_min_m", &SensorModel::range_min_m},
                                           {"range_max_m", &SensorModel::range_max_m},
                                           {"time_per_beam_s", &SensorModel::time_per_beam_s},
                                           {"scan_period_s", &SensorModel::scan_period_s}};
struct NoiseNumber {
  const char* key;
  double SensorNoise::*member;
};
constexpr NoiseNumber kNoiseNumbers[] = {{"sigma_m", &SensorNoise::sigma_m},
                                         {"sigma_relative", &SensorNoise::sigma_relative},
                                         {"relative_from_m", &SensorNoise::relative_from_m},
                                         {"bearing_sigma_rad", &SensorNoise::bearing_sigma_rad},
                                         {"quantum_m", &SensorNoise::quantum_m},
                                         {"dropout_probability", &SensorNoise::dropout_probability},
                                         {"dropout_grazing", &SensorNoise::dropout_grazing},
                                         {"spurious_probability", &SensorNoise::spurious_probability},
                                         {"beam_divergence_rad", &SensorNoise::beam_divergence_rad}};

/// JSON has no infinities, so they are written as text.
Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(number_text(value));
}

double number_of(const Json& json, const char* key, const fs::path& file) {
  const auto found = json.find(key);
  if (found != json.end() && found->is_number()) return found->get<double>();
  if (found != json.end() && *found == "inf") return std::numeric_limits<double>::infinity();
  if (found != json.end() && *found == "-inf") return -std::numeric_limits<double>::infinity();
  throw ConfigError(file.string() + ": '" + key + "' must be a number; found " +
                    (found == json.end() ? "nothing" : io::json_line(*found)));
}

Json scan_json(const Recording& recording) {
  const SensorModel& sensor = recording.observed.sensor;
  Json json{{"schema", 1},
            {"sensor_name", sensor.name},
            {"sensor_source", sensor.source},
            {"angle_min_rad", json_number(sensor.geometry.angle_min())},
            {"angle_step_rad", json_number(sensor.geometry.angle_step())},
            {"beams", sensor.geometry.beams()},
            {"frames", recording.observed.frames.size()}};
  for (const auto& [key, member] : kSensorNumbers) json[key] = json_number(sensor.*member);
  for (const auto& [key, member] : kNoiseNumbers) json["noise"][key] = json_number(sensor.noise.*member);
  return json;
}

std::string walls_csv(const Truth& truth) {
  io::CsvWriter csv({"wall", "label", "x1_m", "y1_m", "x2_m", "y2_m"});
  for (std::size_t i = 0; i < truth.walls.size(); ++i) {
    const Segment& s = truth.walls[i].segment;
    csv.integer(static_cast<long long>(i)).text(truth.walls[i].label);
    csv.number(s.a.x()).number(s.a.y()).number(s.b.x()).number(s.b.y()).end_row();
  }
  return csv.str();
}

void pose_fields(io::CsvWriter& csv, const Pose2& pose) {
  csv.number(pose.x()).number(pose.y()).number(pose.yaw());
}

const std::vector<std::string> kReferenceColumns{"frame", "x_m", "y_m", "yaw_cos", "yaw_sin"};
const std::vector<std::string> kRelationColumns{"first", "second", "x_m", "y_m", "yaw_cos", "yaw_sin"};

void exact_pose_fields(io::CsvWriter& csv, const Pose2& pose) {
  csv.number(pose.x()).number(pose.y()).number(pose.cos()).number(pose.sin());
}

Pose2 exact_pose_from(const io::CsvTable& csv, std::size_t row) {
  const Vec2 place(csv.number(row, "x_m"), csv.number(row, "y_m"));
  const Vec2 rotation(csv.number(row, "yaw_cos"), csv.number(row, "yaw_sin"));
  if (!place.allFinite() || !(std::abs(rotation.norm() - 1.0) < 1e-9))
    csv.refuse(row, "the pose is not a finite place with a unit vector");
  return Pose2::from_unit(place, rotation);
}

std::string frames_csv(const Recording& recording) {
  io::CsvWriter csv({"frame", "t_s", "true_x_m", "true_y_m", "true_yaw_rad", "odom_x_m", "odom_y_m", "odom_yaw_rad"});
  for (std::size_t k = 0; k < recording.observed.frames.size(); ++k) {
    const Frame& frame = recording.observed.frames[k];
    csv.integer(static_cast<long long>(k)).number(frame.stamp_s);
    if (recording.truth)
      pose_fields(csv, recording.truth->world_from_sensor[k]);
    else
      csv.empty().empty().empty();
    pose_fields(csv, frame.odom_from_sensor);
    csv.end_row();
  }
  return csv.str();
}

std::string lines_csv(const ScanSet& scans) {
  io::CsvWriter csv({"frame", "line", "x1_m", "y1_m", "x2_m", "y2_m"});
  for (std::size_t k = 0; k < scans.frames.size(); ++k)
    for (std::size_t i = 0; i < scans.frames[k].lines.size(); ++i) {
      const Segment& s = scans.frames[k].lines[i];
      csv.integer(static_cast<long long>(k)).integer(static_cast<long long>(i));
      csv.number(s.a.x()).number(s.a.y()).number(s.b.x()).number(s.b.y()).end_row();
    }
  return csv.str();
}

/// Poses to compare with have their exact unit vectors here: no module sees them, so that rotations.npy stays what it
/// is.
std::string reference_poses_csv(const std::vector<Pose2>& poses) {
  io::CsvWriter csv(kReferenceColumns);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    csv.integer(static_cast<long long>(k));
    exact_pose_fields(csv, poses[k]);
    csv.end_row();
  }
  return csv.str();
}

std::string relations_csv(const std::vector<PoseRelation>& relations) {
  io::CsvWriter csv(kRelationColumns);
  for (const PoseRelation& relation : relations) {
    csv.integer(relation.first).integer(relation.second);
    exact_pose_fields(csv, relation.first_from_second);
    csv.end_row();
  }
  return csv.str();
}

void read_lines(const io::CsvTable& csv, ScanSet& scans) {
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const int frame = csv.index(r, "frame");
    if (frame < 0 || static_cast<std::size_t>(frame) >= scans.frames.size())
      csv.refuse(r, "frame " + std::to_string(frame) + " is not in frames.csv");
    const Segment line{{csv.number(r, "x1_m"), csv.number(r, "y1_m")}, {csv.number(r, "x2_m"), csv.number(r, "y2_m")}};
    if (!line.a.allFinite() || !line.b.allFinite()) csv.refuse(r, "the line is not finite");
    scans.frames[static_cast<std::size_t>(frame)].lines.push_back(line);
  }
}

std::vector<Pose2> read_reference_poses(const io::CsvTable& csv, std::size_t frames, const fs::path& file) {
  std::vector<Pose2> poses;
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    if (csv.index(r, "frame") != static_cast<int>(r)) csv.refuse(r, "frames must be numbered 0, 1, 2, ...");
    poses.push_back(exact_pose_from(csv, r));
  }
  if (poses.size() != frames)
    throw ConfigError(file.string() + ": " + std::to_string(poses.size()) + " poses for " + std::to_string(frames) +
                      " frames");
  return poses;
}

std::vector<PoseRelation> read_relations(const io::CsvTable& csv, std::size_t frames) {
  std::vector<PoseRelation> relations;
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const PoseRelation relation{csv.index(r, "first"), csv.index(r, "second"), exact_pose_from(csv, r)};
    for (const int frame : {relation.first, relation.second})
      if (frame < 0 || static_cast<std::size_t>(frame) >= frames)
        csv.refuse(r, "frame " + std::to_string(frame) + " is not in frames.csv");
    relations.push_back(relation);
  }
  return relations;
}

/// All files but scan.json.
Files data_files(const Recording& recording) {
  const auto& frames = recording.observed.frames;
  const auto beams = static_cast<std::size_t>(recording.observed.sensor.geometry.beams());
  std::vector<double> rotations;
  std::vector<double> ranges;
  rotations.reserve(4 * frames.size());
  ranges.reserve(beams * frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Pose2& odom = frames[k].odom_from_sensor;
    if (frames[k].ranges.size() != beams)
      throw ConfigError("frame " + std::to_string(k) + " has " + std::to_string(frames[k].ranges.size()) +
                        " ranges; the sensor has " + std::to_string(beams) + " beams");
    ranges.insert(ranges.end(), frames[k].ranges.begin(), frames[k].ranges.end());
    if (recording.truth) {
      const Pose2& pose = recording.truth->world_from_sensor[k];
      rotations.insert(rotations.end(), {pose.cos(), pose.sin(), odom.cos(), odom.sin()});
    } else {
      rotations.insert(rotations.end(), {kNan, kNan, odom.cos(), odom.sin()});
    }
  }
  Files files;
  files.emplace_back(kFramesFile.name(), frames_csv(recording));
  files.emplace_back(kRotationsFile.name(), io::npy_bytes(rotations, frames.size(), 4));
  files.emplace_back(kRangesFile.name(), io::npy_bytes(ranges, frames.size(), beams));
  if (recording.observed.has_given_lines()) files.emplace_back(kGivenLinesFile.name(), lines_csv(recording.observed));
  if (recording.reference && !recording.reference->world_from_sensor.empty())
    files.emplace_back(kReferencePosesFile.name(), reference_poses_csv(recording.reference->world_from_sensor));
  if (recording.reference && !recording.reference->relations.empty())
    files.emplace_back(kRelationsFile.name(), relations_csv(recording.reference->relations));
  if (recording.truth) {
    files.emplace_back(kWallsFile.name(), walls_csv(*recording.truth));
    files.emplace_back(kTrueRangesFile.name(), io::npy_bytes(recording.truth->ranges, frames.size(), beams));
    files.emplace_back(kWallIdsFile.name(), io::npy_bytes(recording.truth->wall_ids, frames.size(), beams));
  }
  return files;
}

std::string hash_of(const Files& data, const Json& scan_without_hash) {
  io::Sha256 hash;
  for (const auto& [name, bytes] : data) hash.part(name, bytes);
  return hash.part(kScanFile.name(), io::json_line(scan_without_hash)).hex();
}

void check_truth(const Recording& recording) {
  if (!recording.truth) return;
  const std::size_t frames = recording.observed.frames.size();
  const std::size_t cells = frames * static_cast<std::size_t>(recording.observed.sensor.geometry.beams());
  SCANBENCH_ASSERT(recording.truth->world_from_sensor.size() == frames);
  SCANBENCH_ASSERT(recording.truth->ranges.size() == cells);
  SCANBENCH_ASSERT(recording.truth->wall_ids.size() == cells);
}

SensorModel sensor_from(const Json& json, const fs::path& file) try {
  SensorModel sensor;
  sensor.name = json.value("sensor_name", "");
  sensor.source = json.value("sensor_source", "");
  const double beams = number_of(json, "beams", file);
  if (!(beams >= 0 && beams <= 1e7) || beams != std::floor(beams))
    throw ConfigError(file.string() + ": beams is " + number_text(beams) + "; allowed: a whole number 0 .. 10000000");
  sensor.geometry = ScanGeometry(number_of(json, "angle_min_rad", file), number_of(json, "angle_step_rad", file),
                                 static_cast<int>(beams));
  // A recording made by another program needs only the geometry and the range limits.
  for (const auto& [key, member] : kSensorNumbers)
    if (json.contains(key) || member == &SensorModel::range_min_m || member == &SensorModel::range_max_m)
      sensor.*member = number_of(json, key, file);
  if (const auto noise = json.find("noise"); noise != json.end() && noise->is_object())
    for (const auto& [key, member] : kNoiseNumbers)
      if (noise->contains(key)) sensor.noise.*member = number_of(*noise, key, file);
  return sensor;
} catch (const Json::exception& e) {
  refuse_json(file, e);
}

template <class T>
void check_shape(const io::NpyArray<T>& array, std::size_t rows, std::size_t columns, const fs::path& file) {
  if (array.rows != rows || array.columns != columns)
    throw ConfigError(file.string() + ": found " + std::to_string(array.rows) + " x " + std::to_string(array.columns) +
                      " values; expected frames x beams = " + std::to_string(rows) + " x " + std::to_string(columns));
}

/// Reads a pose from a row of frames.csv, with the exact rotation if there is one.
Pose2 pose_from(const io::CsvTable& csv, std::size_t row, const std::string& prefix, const double* rotation) {
  const Vec2 t(csv.number(row, prefix + "_x_m"), csv.number(row, prefix + "_y_m"));
  const double yaw = csv.number(row, prefix + "_yaw_rad");
  if (!t.allFinite() || !std::isfinite(yaw)) csv.refuse(row, "the " + prefix + " pose is not finite");
  const Pose2 pose(t, yaw);
  if (rotation == nullptr) return pose;
  const double error = std::hypot(pose.cos() - rotation[0], pose.sin() - rotation[1]);
  if (!(error < 1e-9)) csv.refuse(row, prefix + "_yaw_rad disagrees with rotations.npy");
  return Pose2::from_unit(t, {rotation[0], rotation[1]});
}

std::pair<Files, std::string> files_and_hash(const Recording& recording) {
  check_truth(recording);
  Files files = data_files(recording);
  Json scan = scan_json(recording);
  std::string hash = hash_of(files, scan);
  scan["content_hash"] = hash;
  files.emplace_back(kScanFile.name(), io::json_text(scan) + "\n");
  return {std::move(files), std::move(hash)};
}

}  // namespace

Files recording_files(const Recording& recording) {
  return files_and_hash(recording).first;
}

std::string recording_hash(const Recording& recording) {
  check_truth(recording);
  return hash_of(data_files(recording), scan_json(recording));
}

std::string write_recording(const fs::path& folder, const Recording& recording) {
  const auto [files, hash] = files_and_hash(recording);
  for (const auto& [name, bytes] : files) io::write_staged_file(folder / name, bytes);
  return hash;
}

std::string save_recording(const fs::path& folder, const Recording& recording) {
  io::StagedFolder staged(folder);
  const std::string hash = write_recording(staged.path(), recording);
  staged.commit();
  return hash;
}

Recording load_recording(const StoredFiles& recorded) {
  const fs::path scan_file = recorded.path(kScanFile);
  Json scan = load_json_object(recorded, kScanFile);
  Recording recording;
  recording.observed.sensor = sensor_from(scan, scan_file);
  const auto beams = static_cast<std::size_t>(recording.observed.sensor.geometry.beams());
  Files files;
  const auto bytes_of = [&](const RunFile& file) -> const std::string& {
    return files.emplace_back(file.name(), recorded.read(file)).second;
  };

  const io::CsvTable frames(bytes_of(kFramesFile), recorded.path(kFramesFile),
                            {"frame", "t_s", "odom_x_m", "odom_y_m", "odom_yaw_rad"});
  const std::size_t count = frames.rows();
  if (scan.contains("frames") && number_of(scan, "frames", scan_file) != static_cast<double>(count))
    throw ConfigError(scan_file.string() + ": frames is " + io::json_line(scan["frames"]) + "; frames.csv has " +
                      std::to_string(count));
  io::NpyArray<double> rotations;
  const bool exact = recorded.has(kRotationsFile);
  if (exact) {
    rotations = io::parse_npy_float64(bytes_of(kRotationsFile), recorded.path(kRotationsFile));
    check_shape(rotations, count, 4, recorded.path(kRotationsFile));
  }
  const auto ranges = io::parse_npy_float64(bytes_of(kRangesFile), recorded.path(kRangesFile));
  check_shape(ranges, count, beams, recorded.path(kRangesFile));
  for (std::size_t k = 0; k < count; ++k) {
    if (frames.index(k, "frame") != static_cast<int>(k)) frames.refuse(k, "frames must be numbered 0, 1, 2, ...");
    if (!std::isfinite(frames.number(k, "t_s"))) frames.refuse(k, "t_s is not finite");
    const auto row = ranges.values.begin() + static_cast<std::ptrdiff_t>(k * beams);
    const double* rotation = exact ? &rotations.values[4 * k] : nullptr;
    recording.observed.frames.push_back({frames.number(k, "t_s"),
                                         {row, row + static_cast<std::ptrdiff_t>(beams)},
                                         pose_from(frames, k, "odom", exact ? rotation + 2 : nullptr),
                                         {}});
  }
  if (recorded.has(kGivenLinesFile))
    read_lines(
        {bytes_of(kGivenLinesFile), recorded.path(kGivenLinesFile), {"frame", "line", "x1_m", "y1_m", "x2_m", "y2_m"}},
        recording.observed);
  if (recorded.has(kReferencePosesFile)) {
    const fs::path file = recorded.path(kReferencePosesFile);
    recording.reference.emplace().world_from_sensor =
        read_reference_poses({bytes_of(kReferencePosesFile), file, kReferenceColumns}, count, file);
  }
  if (recorded.has(kRelationsFile)) {
    if (!recording.reference) recording.reference.emplace();
    recording.reference->relations =
        read_relations({bytes_of(kRelationsFile), recorded.path(kRelationsFile), kRelationColumns}, count);
  }
  if (recorded.has(kWallsFile)) {
    Truth truth;
    const io::CsvTable walls(bytes_of(kWallsFile), recorded.path(kWallsFile),
                             {"wall", "label", "x1_m", "y1_m", "x2_m", "y2_m"});
    for (std::size_t i = 0; i < walls.rows(); ++i)
      truth.walls.push_back(
          {walls.text(i, "label"),
           {{walls.number(i, "x1_m"), walls.number(i, "y1_m")}, {walls.number(i, "x2_m"), walls.number(i, "y2_m")}}});
    for (std::size_t k = 0; k < count; ++k)
      truth.world_from_sensor.push_back(pose_from(frames, k, "true", exact ? &rotations.values[4 * k] : nullptr));
    auto true_ranges = io::parse_npy_float64(bytes_of(kTrueRangesFile), recorded.path(kTrueRangesFile));
    check_shape(true_ranges, count, beams, recorded.path(kTrueRangesFile));
    truth.ranges = std::move(true_ranges.values);
    auto ids = io::parse_npy_int32(bytes_of(kWallIdsFile), recorded.path(kWallIdsFile));
    check_shape(ids, count, beams, recorded.path(kWallIdsFile));
    for (const std::int32_t id : ids.values)
      if (id < -1 || id >= static_cast<std::int32_t>(truth.walls.size()))
        throw ConfigError(recorded.path(kWallIdsFile).string() + ": wall " + std::to_string(id) +
                          " is not in walls.csv; allowed: -1 .. " + std::to_string(truth.walls.size()) + " - 1");
    truth.wall_ids = std::move(ids.values);
    recording.truth = std::move(truth);
  }
  if (scan.contains("content_hash")) {
    const Json stated = scan["content_hash"];
    scan.erase("content_hash");
    if (stated != hash_of(files, scan))
      throw ConfigError(recorded.folder().string() +
                        ": the recording is damaged: its bytes do not have the content hash " + io::json_line(stated) +
                        " that scan.json states");
  }
  return recording;
}

std::string stated_recording_hash(const StoredFiles& recording) {
  return with_json_of(recording, kScanFile, [](const Json& json) { return json.value("content_hash", ""); });
}

double stated_scans(const StoredFiles& recording) {
  return with_json_of(recording, kScanFile, [](const Json& json) { return json.value("frames", 0.0); });
}

}  // namespace scanbench::runs
