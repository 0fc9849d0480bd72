// Runs one input through every reader of users' files. Used by the fuzzers and by the test of their corpus.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/truth.hpp"
#include "harness/io/exchange/export.hpp"
#include "harness/io/exchange/log.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/suite.hpp"
#include "harness/study/scenario/wall_table.hpp"
#include "harness/study/scenario/world_file.hpp"
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
  allow_refusal([&] { study::parse_world(bytes, "fuzz.yaml"); });
  allow_refusal([&] { study::parse_vector_map(bytes, "fuzz.txt"); });
  allow_refusal([&] { study::parse_suite(bytes, "/nonexistent/fuzz.yaml"); });
  std::string effective;
  allow_refusal([&] { effective = study::effective_yaml(study::parse_scenario(bytes, "/nonexistent/fuzz.yaml")); });
  if (effective.empty()) return;
  const std::string again = study::effective_yaml(study::parse_scenario(effective, "/nonexistent/fuzz.yaml"));
  if (again != effective) throw InternalError("the effective scenario is not stable");
}

/// Reads the bytes as a table of walls. If they are one, the table that is written of its walls must be read back to
/// the same table, and the walls must be those of a world that lists them as YAML.
inline void run_world(std::string_view bytes) {
  std::vector<Wall> walls;
  allow_refusal([&] { walls = study::parse_wall_table(std::string(bytes), "fuzz.csv"); });
  if (walls.empty()) return;
  const std::string table = study::wall_table(walls);
  if (study::wall_table(study::parse_wall_table(table, "fuzz.csv")) != table)
    throw InternalError("the table of walls is not stable");
  sim::World world;
  world.walls = std::move(walls);
  allow_refusal([&] {
    sim::validate(world);
    const std::string text = "schema: 1\n" + io::write_yaml(study::to_yaml(world));
    if (study::wall_table(study::parse_world(text, "fuzz.yaml").walls) != table)
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
    recording = io::parse_log(bytes.substr(1), "fuzz.log", reader.first, reader.second, sim::make_sensor("custom", {}));
  });
  if (recording.observed.frames.empty()) return;
  for (const char* target : {"carmen", "csv"}) {
    const std::string text = io::export_text(recording, target);
    const Recording back =
        io::parse_log(text, "fuzz.log", target, io::import_params(recording, target), recording.observed.sensor);
    if (back.observed.frames.size() != recording.observed.frames.size())
      throw InternalError("frames were lost in export and import");
  }
}

}  // namespace scanbench::fuzz
