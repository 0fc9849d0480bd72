// Folder of a recording: exact values, contract, hash and damage.
#include "harness/runs/store/recording_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/npy.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "sim/line_copies.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<double> pose_numbers(const Pose2& p) {
  return {p.x(), p.y(), p.cos(), p.sin()};
}

TEST(RecordingFolder, GivesBackEveryBitOfARecording) {
  for (const bool with_truth : {true, false}) {
    const support::TemporaryFolder folder;
    const Recording saved = fixtures::random_recording(7, 40, 33, with_truth);
    save_recording(folder.path() / "r", saved);
    const Recording loaded = load_recording(folder.path() / "r");
    EXPECT_EQ(recording_files(loaded), recording_files(saved));

    const SensorModel& sensor = loaded.observed.sensor;
    EXPECT_EQ(sensor.name, saved.observed.sensor.name);
    EXPECT_EQ(sensor.geometry.angle_step(), saved.observed.sensor.geometry.angle_step());
    EXPECT_TRUE(std::isinf(sensor.range_max_m));
    EXPECT_EQ(sensor.noise.sigma_m, 0.1 + 0.2);
    ASSERT_EQ(loaded.observed.frames.size(), 40u);
    for (std::size_t k = 0; k < 40; ++k) {
      const Frame& a = loaded.observed.frames[k];
      const Frame& b = saved.observed.frames[k];
      EXPECT_EQ(fixtures::bits(a.ranges), fixtures::bits(b.ranges));
      EXPECT_EQ(fixtures::bits(pose_numbers(a.odom_from_sensor)), fixtures::bits(pose_numbers(b.odom_from_sensor)));
    }
    ASSERT_EQ(loaded.truth.has_value(), with_truth);
    if (!with_truth) continue;
    EXPECT_EQ(fixtures::bits(loaded.truth->ranges), fixtures::bits(saved.truth->ranges));
    EXPECT_EQ(loaded.truth->wall_ids, saved.truth->wall_ids);
    EXPECT_EQ(loaded.truth->walls[0].label, saved.truth->walls[0].label);
    EXPECT_EQ(loaded.truth->walls[0].segment, saved.truth->walls[0].segment);
    for (std::size_t k = 0; k < 40; ++k)
      EXPECT_EQ(fixtures::bits(pose_numbers(loaded.truth->world_from_sensor[k])),
                fixtures::bits(pose_numbers(saved.truth->world_from_sensor[k])));
  }
}

TEST(RecordingFolder, GivesBackEveryBitOfThePosesToCompareWith) {
  const support::TemporaryFolder folder;
  Recording saved = fixtures::random_recording(7, 3, 5, false);
  saved.reference = ReferencePoses{{{0.1, 0.2, 0.3}, {1.0 / 3, -2.0 / 7, 3.1}, {0, 0, -1.1}},
                                   {{2, 0, {1.0 / 7, 0.3, 2.2}}, {0, 1, {1, 1, -0.7}}}};
  save_recording(folder.path() / "r", saved);
  const Recording loaded = load_recording(folder.path() / "r");
  ASSERT_TRUE(loaded.reference);
  EXPECT_EQ(loaded.reference->world_from_sensor, saved.reference->world_from_sensor);
  ASSERT_EQ(loaded.reference->relations.size(), 2U);
  EXPECT_EQ(loaded.reference->relations[0].first, 2);
  EXPECT_EQ(loaded.reference->relations[0].second, 0);
  EXPECT_EQ(loaded.reference->relations[0].first_from_second, saved.reference->relations[0].first_from_second);

  const std::string relations = io::read_file(folder.path() / "r" / "relations.csv");
  io::write_file_atomically(folder.path() / "r" / "relations.csv", relations + "0,3,0,0,1,0\n");
  EXPECT_THAT(support::config_refusal([&] { load_recording(folder.path() / "r"); }),
              HasSubstr("relations.csv:4: frame 3 is not in frames.csv"));
}

TEST(RecordingFolder, HasTheFilesAndColumnsOfTheContract) {
  const support::TemporaryFolder folder;
  const fs::path r = folder.path() / "r";
  save_recording(r, fixtures::random_recording(1, 3, 4, true));
  EXPECT_THAT(fixtures::listing(r), ElementsAre("frames.csv", "ranges.npy", "rotations.npy", "scan.json",
                                                "true_ranges.npy", "wall_ids.npy", "walls.csv"));
  EXPECT_THAT(
      io::CsvTable(io::read_file(r / "frames.csv"), "f").columns(),
      ElementsAre("frame", "t_s", "true_x_m", "true_y_m", "true_yaw_rad", "odom_x_m", "odom_y_m", "odom_yaw_rad"));
  EXPECT_THAT(io::CsvTable(io::read_file(r / "walls.csv"), "f").columns(),
              ElementsAre("wall", "label", "x1_m", "y1_m", "x2_m", "y2_m"));
  EXPECT_EQ(io::parse_npy_float64(io::read_file(r / "ranges.npy"), "f").rows, 3u);
  EXPECT_EQ(io::parse_npy_int32(io::read_file(r / "wall_ids.npy"), "f").columns, 4u);

  save_recording(r, fixtures::random_recording(1, 3, 4, false));
  EXPECT_THAT(fixtures::listing(r), ElementsAre("frames.csv", "ranges.npy", "rotations.npy", "scan.json"));
  const io::CsvTable frames(io::read_file(r / "frames.csv"), "f");
  EXPECT_EQ(frames.text(0, "true_x_m") + frames.text(0, "true_y_m") + frames.text(0, "true_yaw_rad"), "");
}

TEST(RecordingFolder, GivesBackLinesInsteadOfScans) {
  const support::TemporaryFolder folder;
  const fs::path r = folder.path() / "r";
  sim::World world;
  world.walls = {{"a", {{0, 0}, {1.1, 0}}}, {"b", {{0, 1}, {0.3, 1}}}};
  const Recording saved = sim::line_copies(world, {.copies = 3, .rotation_sigma_rad = 0.1, .shift_sigma_m = 0.2}, 4);
  save_recording(r, saved);
  EXPECT_THAT(fixtures::listing(r), ElementsAre("frames.csv", "lines.csv", "ranges.npy", "rotations.npy", "scan.json",
                                                "true_ranges.npy", "wall_ids.npy", "walls.csv"));
  // Otherwise a new run in the same folder would keep it beside scans, as a file that no run writes.
  for (const auto& name : fixtures::listing(r)) EXPECT_TRUE(is_run_file(fs::path("recordings/s/1") / name)) << name;
  const Recording loaded = load_recording(r);
  EXPECT_EQ(recording_files(loaded), recording_files(saved));
  ASSERT_EQ(loaded.observed.frames.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(loaded.observed.frames[k].lines, saved.observed.frames[k].lines);
    EXPECT_EQ(loaded.observed.frames[k].odom_from_sensor, saved.observed.frames[k].odom_from_sensor);
  }
  EXPECT_NE(recording_hash(sim::line_copies(world, {.copies = 3}, 4)), recording_hash(saved));
}

TEST(RecordingFolder, HashChangesWithEveryPartAndNotOtherwise) {
  const Recording base = fixtures::random_recording(3, 2, 8, true);
  EXPECT_EQ(recording_hash(base), recording_hash(fixtures::random_recording(3, 2, 8, true)));
  std::vector<Recording> others(7, base);
  others[0].observed.frames[1].ranges[3] = std::nextafter(5.0, 6.0);
  others[1].observed.frames[1].stamp_s += 1e-9;
  others[2].truth->walls[0].label = "b";
  others[3].truth->wall_ids[0] ^= 1;
  others[4].observed.sensor.noise.quantum_m = 0.001;
  others[5].truth.reset();
  others[6].observed.frames[0].odom_from_sensor = Pose2::from_unit({0, 0}, {1, 0});
  for (const auto& other : others) EXPECT_NE(recording_hash(other), recording_hash(base));
  const support::TemporaryFolder folder;
  EXPECT_EQ(save_recording(folder.path() / "r", base), recording_hash(base));
  EXPECT_EQ(stated_recording_hash(folder.path() / "r"), recording_hash(base));
}

TEST(RecordingFolder, ReportsDamageByFile) {
  const support::TemporaryFolder folder;
  const fs::path r = folder.path() / "r";
  const auto message = [&](const std::string& name, const std::string& bytes) -> std::string {
    save_recording(r, fixtures::random_recording(1, 3, 4, true));
    if (bytes.empty())
      fs::remove(r / name);
    else
      io::write_file_atomically(r / name, bytes);
    try {
      load_recording(r);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  };
  std::string ranges;
  for (const auto& [name, bytes] : recording_files(fixtures::random_recording(1, 3, 4, true)))
    if (name == "ranges.npy") ranges = bytes;
  ranges.back() = static_cast<char>(ranges.back() ^ 1);
  EXPECT_THAT(message("ranges.npy", ranges), HasSubstr("damaged"));
  EXPECT_THAT(message("ranges.npy", ""), HasSubstr("ranges.npy: no such file"));
  EXPECT_THAT(message("true_ranges.npy", io::npy_bytes(std::vector<double>(8), 2, 4)),
              HasSubstr("expected frames x beams"));
  EXPECT_THAT(message("wall_ids.npy", io::npy_bytes(std::vector<std::int32_t>(12, 9), 3, 4)), HasSubstr("wall 9"));
  EXPECT_THAT(message("scan.json", "[]"), HasSubstr("scan.json: not a JSON object"));
  EXPECT_THAT(message("scan.json", "{\"beams\": -1}"), HasSubstr("beams is -1"));
  EXPECT_THAT(message("frames.csv", "frame,t_s,odom_x_m,odom_y_m,odom_yaw_rad\n0,0,x,0,0\n1,0,0,0,0\n2,0,0,0,0\n"),
              HasSubstr("frames.csv:2: odom_x_m is 'x'"));
}

TEST(RecordingFolder, ReadsARecordingMadeElsewhere) {
  const support::TemporaryFolder folder;
  io::write_file_atomically(
      folder.path() / "scan.json",
      R"({"angle_min_rad": 0, "angle_step_rad": 1.5, "beams": 2, "range_min_m": 0, "range_max_m": 9})");
  io::write_file_atomically(folder.path() / "frames.csv", "frame,t_s,odom_x_m,odom_y_m,odom_yaw_rad\n0,1.5,1,2,3\n");
  io::write_file_atomically(folder.path() / "ranges.npy", io::npy_bytes(std::vector<double>{4, 5}, 1, 2));
  const Recording recording = load_recording(folder.path());
  EXPECT_FALSE(recording.truth.has_value());
  EXPECT_EQ(recording.observed.frames[0].ranges[1], 5.0);
  EXPECT_NEAR(recording.observed.frames[0].odom_from_sensor.yaw(), 3.0, 1e-15);
  EXPECT_EQ(recording.observed.sensor.range_max_m, 9.0);
}

}  // namespace
}  // namespace scanbench::runs
