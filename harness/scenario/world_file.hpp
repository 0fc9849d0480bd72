// World files: the walls that are scanned, in the project's own YAML format or as a plain list of segments.
//
//   schema: 1
//   about: two rooms and a person walking             # optional
//   name: rooms                                       # optional, default: the file's name
//   unit_m: 0.025                                     # optional, metres per unit of the coordinates; default 1
//   segments:                                         # straight walls; each label is used once
//     - [north, 0, 4, 6, 4]                           # [label, x1, y1, x2, y2]
//   polylines:                                        # walls end to end; their labels are fence.1, fence.2, ...
//     fence: [[0, 0], [6, 0], [6, 4]]
//   polygons:                                         # the same, closed
//     box: [[2, 1], [3, 1], [3, 2]]
//   circles:                                          # return beams but are no lines of the truth
//     - [pillar, 5, 3, 0.2]                           # [label, x, y, radius]
//   moving:                                           # round bodies that move; in metres, independent of unit_m
//     - {label: person, radius_m: 0.2, path_m: [[1, 1], [5, 1]], speed_mps: 1.2, loop: true}
//
// loop: false moves a body along its path once, after which it stays at the last point; loop: true moves it to the last
// point, back to the first, and so on. It is at the first point when the recording starts.
//
// A file that ends in .txt or .txt.gz is a vector map as used for robot localisation: "x1, y1, x2, y2" per line (commas
// or blanks), metres, `#` begins a comment; walls are labelled with their line's number. Segments without length are
// skipped and counted.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/yaml/gate.hpp"
#include "harness/yaml/reader.hpp"
#include "sim/world.hpp"

namespace scanbench::harness {

/// The largest number of walls in a vector map: more do not fit into an effective scenario (kMaxYamlNodes).
inline constexpr std::size_t kMaxVectorMapWalls = 300000;

struct LoadedWorld {
  sim::World world;  ///< metres
  std::string text;  ///< the file's bytes, unpacked
  int dropped = 0;   ///< segments without length in a vector map
};

/// Reads and checks a world file of either format. Throws ConfigError with file:line:col. Rows of walls in the form of
/// wall_rows.hpp take about a hundredth of the time that the YAML parser takes for them.
LoadedWorld load_world(const std::filesystem::path& path);

/// The same from memory; `file` is for messages, its stem is the world's name.
sim::World parse_world(std::string_view text, const std::string& file);

/// parse_world() by the YAML parser alone: the reference for tests and benchmarks.
sim::World parse_world_yaml(std::string_view text, const std::string& file);

LoadedWorld parse_vector_map(std::string_view text, const std::string& file);

/// Reads a world from the map of a world file or of a scenario's key `world`. Requests every key of the format except
/// `schema`; the caller calls done(). Throws PlacedError. With `rows`, the walls of `segments` are these, which are
/// moved out of it (wall_rows.hpp); the caller then calls sim::validate(), which compares labels.
sim::World read_world(YamlMap& map, const std::string& default_name, std::vector<Wall>* rows = nullptr);

/// The world as a map that read_world() reads back to the same numbers (metres, every wall a segment).
YamlNode to_yaml(const sim::World& world);

}  // namespace scanbench::harness
