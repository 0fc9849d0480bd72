// Runs one input through every reader of users' files. Used by the fuzzers and by the test of their corpus.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/truth.hpp"
#include "harness/exchange/export.hpp"
#include "harness/exchange/log.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/scenario/suite.hpp"
#include "harness/scenario/wall_table.hpp"
#include "harness/scenario/world_file.hpp"
#include "harness/yaml/writer.hpp"
#include "sim/sensors.hpp"
#include "sim/world.hpp"

namespace scanbench::fuzz {

/// Runs `work` and accepts a ConfigError, by which a reader refuses the input. Any other exception is a fault.
template <class Work>
void allow_refusal(Work&& work) {
  try {
    work();
  } catch (const ConfigError&) {
  }
}

/// Reads the bytes as a scenario, as a world of either format and as a suite. If a scenario loads, its effective form
/// must load too and have the same effective form.
inline void run_yaml(std::string_view bytes) {
  allow_refusal([&] { harness::parse_world(bytes, "fuzz.yaml"); });
  allow_refusal([&] { harness::parse_vector_map(bytes, "fuzz.txt"); });
  allow_refusal([&] { harness::parse_suite(bytes, "/nonexistent/fuzz.yaml"); });
  std::string effective;
  allow_refusal([&] { effective = harness::effective_yaml(harness::parse_scenario(bytes, "/nonexistent/fuzz.yaml")); });
  if (effective.empty()) return;
  const std::string again = harness::effective_yaml(harness::parse_scenario(effective, "/nonexistent/fuzz.yaml"));
  if (again != effective) throw InternalError("the effective scenario is not stable");
}

/// Reads the bytes as a table of walls. If they are one, the table that is written of its walls must be read back to
/// the same table, and the walls must be those of a world that lists them as YAML.
inline void run_world(std::string_view bytes) {
  std::vector<Wall> walls;
  allow_refusal([&] { walls = harness::parse_wall_table(std::string(bytes), "fuzz.csv"); });
  if (walls.empty()) return;
  const std::string table = harness::wall_table(walls);
  if (harness::wall_table(harness::parse_wall_table(table, "fuzz.csv")) != table)
    throw InternalError("the table of walls is not stable");
  sim::World world;
  world.walls = std::move(walls);
  allow_refusal([&] {
    sim::validate(world);
    const std::string text = "schema: 1\n" + harness::write_yaml(harness::to_yaml(world));
    if (harness::wall_table(harness::parse_world(text, "fuzz.yaml").walls) != table)
      throw InternalError("the walls have other values for the YAML parser");
  });
}

/// Reads a log from the bytes after the first, which selects format and options. A log that can be read must survive
/// export and reading.
inline void run_log(std::string_view bytes) {
  if (bytes.empty()) return;
  using Text = std::string;
  static const std::array<std::pair<const char*, ParamSet>, 6> kReaders = {{
      {"carmen", {{"no_return_m", 50.0}}},
      {"carmen", {{"poses", Text("vertex")}, {"first_angle_deg", -10.0}, {"step_deg", 1.0}, {"sensor_x_m", 0.5}}},
      {"carmen", {{"poses", Text("odometry")}, {"step_deg", -0.5}, {"range_min_m", 0.1}, {"every", std::int64_t{2}}}},
      {"csv", {{"step_deg", 1.0}}},
      {"csv", {{"step_deg", 0.5}, {"columns", Text("t_ms skip:2 x_m y_m yaw_deg ranges skip")}, {"unit_m", 0.001}}},
      {"dpslam", {{"step_deg", 1.0}, {"no_return_m", 8.0}}},
  }};
  const auto& reader = kReaders[static_cast<unsigned char>(bytes.front()) % kReaders.size()];
  Recording recording;
  allow_refusal([&] {
    recording =
        harness::parse_log(bytes.substr(1), "fuzz.log", reader.first, reader.second, sim::make_sensor("custom", {}));
  });
  if (recording.observed.frames.empty()) return;
  for (const char* target : {"carmen", "csv"}) {
    const std::string text = harness::export_text(recording, target);
    const Recording back = harness::parse_log(text, "fuzz.log", target, harness::import_params(recording, target),
                                              recording.observed.sensor);
    if (back.observed.frames.size() != recording.observed.frames.size())
      throw InternalError("frames were lost in export and import");
  }
}

}  // namespace scanbench::fuzz
