// Shared by the tests of sweeps: small scenarios, their plans, and what shards have committed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/recording.hpp"
#include "harness/runs/sweep/shard.hpp"
#include "harness/runs/sweep/shard_commit.hpp"
#include "harness/runs/sweep/sweep_plan.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::fixtures {

/// A room with these pipelines; recordings are small.
inline study::Scenario room(const std::string& name, const std::string& seeds, const std::string& pipelines) {
  return study::parse_scenario("schema: 1\nname: " + name + R"(
world: {segments: [[a, 0, 0, 10, 0], [b, 10, 0, 10, 8], [c, 10, 8, 0, 8], [d, 0, 8, 0, 0]]}
sensor: {preset: sick_lms200}
trajectory: {kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 3}
seeds: )" + seeds + "\npipelines:\n" +
                                   pipelines + "metrics: [test_metrics]\nfigures: [test_traced]\n",
                               "room.yaml");
}

inline const std::string kLine = "  - {name: line, extract: {module: test_line}}\n";
inline const std::string kSkip = "  - {name: skip, extract: {module: test_line, params: {skip: 2}}}\n";

inline std::vector<study::Scenario> two_rooms() {
  return {room("one", "[3, 1, 2]", kLine + kSkip), room("two", "[5, 6]", kLine)};
}

/// Recordings with a scan of time 2, at which the modules of the tests misbehave.
inline Recording with_time_two(const study::Scenario&, std::uint64_t seed, int) {
  return random_recording(seed, 5, 16, true);
}

inline runs::SweepPlan plan_of(const std::vector<study::Scenario>& scenarios, const std::filesystem::path& out,
                               int shards = 3) {
  return runs::plan_sweep(scenarios, {.out = out, .name = "rooms", .shards = shards});
}

inline void run_all(const runs::SweepPlan& plan) {
  for (int shard = 1; shard <= plan.shards; ++shard)
    EXPECT_EQ(runs::run_shard(plan.folder, {.shard = shard}).exit_code(), 0) << shard;
}

/// The folders that shards have committed, of all shards or of one.
inline std::vector<std::filesystem::path> commits_of(const runs::SweepPlan& plan, int shard = 0) {
  std::vector<std::filesystem::path> folders;
  for (const auto& commit : runs::load_commits(plan.folder, shard).whole) folders.push_back(commit.folder);
  return folders;
}

inline void cut(const std::filesystem::path& file) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
}

}  // namespace scanbench::fixtures
