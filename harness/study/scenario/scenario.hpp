// A scenario in memory: everything that a run needs to know, with every default filled in. scenario_file.hpp reads it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/params.hpp"
#include "core/sensor_model.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "sim/line_copies.hpp"
#include "sim/odometry.hpp"
#include "sim/ray_caster.hpp"
#include "sim/tilt.hpp"
#include "sim/world.hpp"

namespace scanbench::study {

/// 2^53: the largest seed that every tool reads back exactly.
inline constexpr std::uint64_t kLargestSeed = 9007199254740992U;

/// Input of a run with scans of a simulated world.
struct SimulatedInput {
  sim::World world;
  std::string sensor_preset;
  ParamSet sensor_params;  ///< effective
  SensorModel sensor;
  ModuleChoice trajectory;
  ParamSet odometry_params;  ///< effective, in the units of the file
  sim::OdometryNoise odometry;
  ParamSet tilt_params;  ///< effective, in the units of the file
  sim::Tilt tilt;
  bool sweep = false;
  sim::CasterKind caster = sim::CasterKind::exact;
};

/// Input of a run with scans of a recorded log.
struct RecordedInput {
  std::filesystem::path log;
  std::string log_as_written;       ///< in the scenario, with ${SCANBENCH_DATA}
  std::string log_sha256;           ///< known without the log, of a scenario that a run folder holds; else empty
  std::string format;               ///< carmen, csv, dpslam
  std::filesystem::path relations;  ///< relative poses to compare estimates with; empty: none
  std::string relations_as_written;
  std::string relations_sha256;  ///< as log_sha256
  ParamSet odometry_params;      ///< of the errors that are added to the poses of the log; effective
  sim::OdometryNoise odometry;
  ParamSet params;  ///< of the reader: no-return value, first angle, pose triple, ...; effective
  std::string sensor_preset;
  ParamSet sensor_params;  ///< effective; its beam angles and range limits are unused, because the log has its own
  SensorModel sensor;
};

/// Input of a run with lines instead of scans: copies of the world's walls, or the lines of a file.
struct LinesInput {
  std::optional<sim::World> world;           ///< the truth; present for copies
  std::filesystem::path file;                ///< empty: copies
  std::string file_as_written;               ///< in the scenario, with ${SCANBENCH_DATA}
  std::string file_name;                     ///< without folders, as the user called it
  std::vector<std::vector<Segment>> frames;  ///< the lines of the file
  ParamSet params;                           ///< of the copies, in the units of the scenario; effective
  sim::LineCopies copies;
};

struct Limits {
  double seconds = 600.0;  ///< per cell, wall time
  double memory_bytes =
      4.0 * 1024 * 1024 * 1024;  ///< per cell; a recording that needs more is refused before it starts
  bool sandbox = false;          ///< programs run under bubblewrap, libraries without network
};

struct Scenario {
  std::string name;  ///< key `name`, or the file's name without extension
  std::filesystem::path path;
  std::string text;  ///< the file's bytes
  io::Mark begin;    ///< where its keys begin in the file
  std::string about;
  std::variant<SimulatedInput, RecordedInput, LinesInput> input;
  std::vector<std::uint64_t> seeds;
  std::vector<PipelineSpec> pipelines;
  std::vector<ModuleChoice> metrics;
  std::vector<ModuleChoice> figures;
  std::filesystem::path published_file;  ///< values that a paper prints (key `published`); empty: none
  std::string published_as_written;      ///< in the scenario, with ${SCANBENCH_DATA}
  Limits limits;
  std::vector<std::string> notes;  ///< for the user: input that was skipped, like walls without length in a vector map

  // Defined once, in scenario.cpp: inline they cost seconds in every unit that has one.
  Scenario();
  Scenario(const Scenario&);
  Scenario(Scenario&&) noexcept;
  Scenario& operator=(const Scenario&);
  Scenario& operator=(Scenario&&) noexcept;
  ~Scenario();
};

/// True if the recording depends on the seed: it is simulated, or a log whose poses get errors.
bool has_chance(const Scenario& scenario);

}  // namespace scanbench::study
