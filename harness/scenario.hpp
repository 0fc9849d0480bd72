// A scenario as its file says it, checked and with every default filled in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "sim/simulate.hpp"

namespace scanbench::harness {

/// A registered thing with its parameters, all of them.
struct ModuleChoice {
  std::string kind;  ///< slot: extract, align, match, map, merge; or metrics, figure
  std::string module;
  ParamSet params;
};

struct PipelineSpec {
  std::string name;
  std::vector<ModuleChoice> slots;  ///< in the order of the chain: extract -> (align | match) -> (map | merge)
  std::string published;            ///< the method's name in Scenario::published_file; may be empty
};

/// Scans come from a simulated world ...
struct SimulatedInput {
  std::string world_file;  ///< as written in the scenario
  std::string world_text;  ///< bytes of that file: part of the scenario's identity
  sim::World world;
  std::string sensor_preset;
  ParamSet sensor_params;  ///< effective
  SensorModel sensor;
  ModuleChoice trajectory;
  sim::OdometryNoise odometry;
  bool sweep = false;
};

/// ... or from a recorded log.
struct RecordedInput {
  std::filesystem::path log;
  std::string format;  ///< carmen, csv, dpslam
  ParamSet params;     ///< of the reader: no-return value, first angle, pose triple, ...; effective
};

struct Limits {
  double seconds = 600.0;                          ///< per cell, wall time
  double memory_bytes = 4.0 * 1024 * 1024 * 1024;  ///< per cell, and of a recording before it starts
};

struct Scenario {
  std::string name;  ///< the file's name without ending
  std::filesystem::path path;
  std::string text;  ///< the file's bytes
  std::string about;
  std::variant<SimulatedInput, RecordedInput> input;
  std::vector<std::uint64_t> seeds;
  std::vector<PipelineSpec> pipelines;
  std::vector<ModuleChoice> metrics;
  std::vector<ModuleChoice> figures;
  std::filesystem::path published_file;  ///< values that a paper prints, shown beside ours; empty: none (key `published`)
  Limits limits;
};

/// Reads and checks a scenario file. `sets` are "key=value" overrides with dotted keys
/// (`pipelines.iepf.extract.params.threshold_m=0.1`). Throws ConfigError with file:line:col, what was found and what is
/// allowed.
Scenario load_scenario(const std::filesystem::path& path, const std::vector<std::string>& sets = {});

/// The scenario with every default written out; loading it again gives the same scenario and the same bytes of every
/// artefact.
std::string effective_yaml(const Scenario& scenario);

/// The recording of a scenario for one seed: simulates, or reads the log (the seed is then unused).
/// Throws ConfigError if it would need more memory than the limit, with the arithmetic.
Recording make_recording(const Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress = {});

}  // namespace scanbench::harness
