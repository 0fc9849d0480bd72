// A scenario as its file says it, checked and with every default filled in.
//
//   schema: 1
//   name: rooms                                  # optional, default: the file's name without ending
//   about: what is shown                         # optional
//   world: {file: worlds/rooms.yaml}             # relative to the scenario; or the keys of a world file themselves
//   sensor: {preset: ladar_2d30, sigma_m: 0.02}  # any field may be overridden
//   trajectory:                                  # kind, its parameters, errors of odometry and tilt
//     {kind: waypoints, points_m: {A: [1, 1], B: [4, 1]}, scans: 200, odometry: {translation_per_m: 0.02}, sweep:
//     false}
//   caster: exact                                # optional; box2d: the reference, slower, equal recordings
//   seed: 1                                      # or seeds: [1, 2], or seeds: {first: 1, count: 20}; default: seed: 1
//   pipelines:                                   # slots: extract, then align or match, then map or merge
//     - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}
//   metrics: [borges2000, {name: segments, params: {}}]
//   figures: [environment]
//   published: published/rooms.csv               # optional: figures that a paper prints
//   limits: {seconds: 600, memory_mib: 4096}     # of a cell; memory also of a recording before it starts
//
// A log takes the place of world, sensor and trajectory: `recording: {log: FILE, format: carmen, ...}` with the options
// of its format (harness/log.hpp); `sensor` beside it gives noise and timing, which algorithms may ask for. Lines take
// the place of sensor and trajectory, and pipelines then have no extract: `lines: {copies: 10, rotation_sigma_deg: 1,
// shift_sigma_m: 0.02}` are as many copies of the world's walls; `lines: {file: FILE}` is a set of one's own
// (harness/line_set.hpp), of which a `world` is the truth. In paths, ${SCANBENCH_DATA} stands for that environment
// variable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/params.hpp"
#include "core/recording.hpp"
#include "sim/line_copies.hpp"
#include "sim/ray_caster.hpp"
#include "sim/simulate.hpp"

namespace scanbench::harness {

/// 2^53: the largest seed that every tool reads back exactly.
inline constexpr std::uint64_t kLargestSeed = 9007199254740992U;

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
  std::string world_text;  ///< bytes of the world's file, unpacked; empty: the world is written into the scenario
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

/// ... or from a recorded log.
struct RecordedInput {
  std::filesystem::path log;
  std::string log_as_written;  ///< in the scenario, with ${SCANBENCH_DATA}
  std::string format;          ///< carmen, csv, dpslam
  ParamSet params;             ///< of the reader: no-return value, first angle, pose triple, ...; effective
  std::string sensor_preset;
  ParamSet sensor_params;  ///< effective; beam angles and range limits of it are not used: the log has its own
  SensorModel sensor;
};

/// ... or there are no scans, but lines: copies of the world's walls, or those of a file.
struct LinesInput {
  std::optional<sim::World> world;           ///< the truth; present for copies
  std::filesystem::path file;                ///< empty: copies
  std::string file_as_written;               ///< in the scenario, with ${SCANBENCH_DATA}
  std::vector<std::vector<Segment>> frames;  ///< what the file holds
  ParamSet params;                           ///< of the copies, in the units of the scenario; effective
  sim::LineCopies copies;
};

struct Limits {
  double seconds = 600.0;                          ///< per cell, wall time
  double memory_bytes = 4.0 * 1024 * 1024 * 1024;  ///< per cell, and of a recording before it starts
};

struct Scenario {
  std::string name;  ///< key `name`, or the file's name without ending
  std::filesystem::path path;
  std::string text;  ///< the file's bytes
  std::string about;
  std::variant<SimulatedInput, RecordedInput, LinesInput> input;
  std::vector<std::uint64_t> seeds;
  std::vector<PipelineSpec> pipelines;
  std::vector<ModuleChoice> metrics;
  std::vector<ModuleChoice> figures;
  std::filesystem::path
      published_file;  ///< values that a paper prints, shown beside ours; empty: none (key `published`)
  Limits limits;
  std::vector<std::string>
      notes;  ///< for the user: what reading passed over, like walls without length in a vector map
};

/// Reads and checks a scenario file. `sets` are "key=value" overrides with dotted keys
/// (`pipelines.iepf.extract.params.threshold_m=0.1`). Throws ConfigError with file:line:col, what was found and what is
/// allowed.
Scenario load_scenario(const std::filesystem::path& path, const std::vector<std::string>& sets = {});

/// The same from memory; files that it names are found relative to `path`.
Scenario parse_scenario(std::string_view text, const std::filesystem::path& path,
                        const std::vector<std::string>& sets = {});

/// The scenario with every default written out, the world in it, in one canonical form; loading it again, from any
/// folder, gives the same scenario, the same bytes of this text and of every artefact.
std::string effective_yaml(const Scenario& scenario);

/// True if the recording depends on the seed: it is simulated, not read.
bool has_chance(const Scenario& scenario);

/// What simulate() gets; its trajectory has the waypoints that figures show. Only for scenarios with a simulated world.
sim::SimulationInput simulation_input(const Scenario& scenario, std::uint64_t seed);

/// Checks what loading leaves until a run: that the path is clear of walls, and that the memory suffices. Throws
/// ConfigError.
void check_scenario(const Scenario& scenario);

/// The recording of a scenario for one seed: simulates, or reads the log (the seed is then unused).
/// Throws ConfigError if it would need more memory than the limit, with the arithmetic.
Recording make_recording(const Scenario& scenario, std::uint64_t seed, int threads,
                         const std::function<void(double)>& progress = {});

}  // namespace scanbench::harness
