// Recordings keep their bytes: SHA-256 of the arrays of every committed simulated scenario, against a committed list.
// A change of the list means that results published with an earlier version cannot be reproduced: it needs a reason.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/pose2.hpp"
#include "core/recording.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "sim/ray_caster.hpp"
#include "tests/support/places.hpp"

namespace scanbench {
namespace {

namespace fs = std::filesystem;

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void add_pose(std::vector<double>& numbers, const Pose2& pose) {
  numbers.insert(numbers.end(), {pose.x(), pose.y(), pose.cos(), pose.sin()});
}

/// One row of the list: scenario, seed, and the hashes of ranges, true_ranges, wall_ids, poses. The poses are stamp,
/// true pose and odometry pose of every frame.
std::string row(const study::Scenario& scenario, std::uint64_t seed) {
  const Recording recording = runs::make_recording(scenario, seed, 1);
  io::Sha256 ranges;
  std::vector<double> poses;
  for (std::size_t k = 0; k < recording.observed.frames.size(); ++k) {
    const Frame& frame = recording.observed.frames[k];
    ranges.add(bytes_of(frame.ranges));
    poses.push_back(frame.stamp_s);
    add_pose(poses, recording.truth->world_from_sensor[k]);
    add_pose(poses, frame.odom_from_sensor);
  }
  std::ostringstream text;
  text << scenario.name << ',' << seed << ',' << ranges.hex() << ','
       << io::sha256_hex(bytes_of(recording.truth->ranges)) << ','
       << io::sha256_hex(bytes_of(recording.truth->wall_ids)) << ',' << io::sha256_hex(bytes_of(poses)) << '\n';
  return text.str();
}

std::vector<fs::path> scenario_files() {
  std::vector<fs::path> files;
  for (const char* folder : {"scenarios", "scenarios/scenes", "tests/golden/scenarios"})
    for (const auto& entry : fs::directory_iterator(places::source_dir() / folder))
      if (entry.path().extension() == ".yaml" && entry.path().filename() != "figures.yaml")  // a catalogue
        files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string list(sim::CasterKind caster) {
  std::string rows = "scenario,seed,ranges,true_ranges,wall_ids,poses\n";
  for (const fs::path& file : scenario_files()) {
    study::Scenario scenario = study::load_scenario(file);
    auto* input = std::get_if<study::SimulatedInput>(&scenario.input);
    if (input == nullptr) continue;
    input->caster = caster;
    for (const std::uint64_t seed : {1U, 2U, 3U}) rows += row(scenario, seed);
  }
  return rows;
}

std::string golden_list() {
  std::ifstream file(places::source_dir() / "tests/golden/recordings.csv");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Recordings, KeepTheBytesOfTheGoldenList) {
  const std::string now = list(sim::CasterKind::exact);
  EXPECT_EQ(now, golden_list()) << "the list as computed now:\n" << now;
}

TEST(Recordings, AreTheSameBytesWithTheReferenceCaster) {
  EXPECT_EQ(list(sim::CasterKind::box2d), golden_list());
}

}  // namespace
}  // namespace scanbench
