// Reads a scenario file, checks it, and fills in every default.
//
//   schema: 1
//   name: rooms                                  # optional, default: the file's name, no extension
//   about: two rooms, seen from a corridor       # optional
//   world: {file: worlds/rooms.yaml}             # relative to the scenario; or the keys of a world file themselves
//   sensor: {preset: ladar_2d30, sigma_m: 0.02}  # any field may be overridden
//   trajectory:                                  # kind, its parameters, errors of odometry and tilt
//     kind: waypoints
//     points_m: {A: [1, 1], B: [4, 1]}
//     scans: 200
//     odometry: {translation_per_m: 0.02}
//     sweep: false
//   caster: exact                                # optional; box2d is a slower reference
//   seed: 1                                      # or seeds: [1, 2], or seeds: {first: 1, count: 20}; default: seed: 1
//   pipelines:                                   # slots: extract, then align or match, then map or merge
//     - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}
//   metrics: [borges2000, {name: segments, params: {}}]
//   figures: [environment]
//   published: published/rooms.csv               # optional: values that a paper prints
//   limits: {seconds: 600, memory_mib: 4096}     # per cell; memory_mib also limits a recording
//
// A log replaces world and trajectory: `recording: {log: FILE, format: carmen, ...}` with the options of its format
// (harness/io/exchange/log.hpp); `sensor` then gives noise and timing, which algorithms may use.
// Lines replace sensor and trajectory, and pipelines then have no extract: `lines: {copies: 10,
// rotation_sigma_deg: 1, shift_sigma_m: 0.02}` are 10 copies of the world's walls; `lines: {file: FILE}` is a set
// of lines (harness/study/scenario/line_set.hpp), for which `world` is the truth. In paths, ${SCANBENCH_DATA} is
// replaced by that environment variable.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/study/scenario/scenario.hpp"

namespace scanbench::study {

/// Reads and checks a scenario file. `sets` are "key=value" overrides with dotted keys
/// (`pipelines.iepf.extract.params.threshold_m=0.1`). Throws ConfigError with file:line:col, what was found and what is
/// allowed.
Scenario load_scenario(const std::filesystem::path& path, const std::vector<std::string>& sets = {});

/// The same from memory; files that it names are found relative to `path`.
Scenario parse_scenario(std::string_view text, const std::filesystem::path& path,
                        const std::vector<std::string>& sets = {});

/// The scenario of a run folder, whose recordings exist: its log may be absent.
Scenario load_recorded_scenario(const std::filesystem::path& path);

}  // namespace scanbench::study
