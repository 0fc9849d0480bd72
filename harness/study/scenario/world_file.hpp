// World files: the walls that are scanned, in the project's own YAML format or as a plain list of segments.
//
//   schema: 1
//   about: two rooms and a person walking             # optional
//   name: rooms                                       # optional, default: the file's name
//   unit_m: 0.025                                     # optional, metres per unit of the coordinates; default 1
//   segments:                                         # straight walls; each label is used once
//     - [north, 0, 4, 6, 4]                           # [label, x1, y1, x2, y2]; or segments: {file: walls.csv}
//   polylines:                                        # walls end to end; their labels are fence.1, fence.2, ...
//     fence: [[0, 0], [6, 0], [6, 4]]
//   polygons:                                         # the same, closed
//     box: [[2, 1], [3, 1], [3, 2]]
//   circles:                                          # return beams but are not lines of the truth
//     - [pillar, 5, 3, 0.2]                           # [label, x, y, radius]
//   moving:                                           # round bodies that move; in metres, independent of unit_m
//     - {label: person, radius_m: 0.2, path_m: [[1, 1], [5, 1]], speed_mps: 1.2, loop: true}
//
// segments: {file: walls.csv} names a table (wall_table.hpp), whose coordinates are in metres, independent of unit_m.
// Its path is relative to this file. It takes about a hundredth of the time that the YAML parser takes for rows.
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

#include "harness/io/yaml/gate.hpp"
#include "harness/io/yaml/reader.hpp"
#include "sim/world.hpp"

namespace scanbench::study {

struct LoadedWorld {
  sim::World world;  ///< metres
  int dropped = 0;   ///< segments without length in a vector map
};

/// Reads and checks a world file of either format. Throws ConfigError with file:line:col.
LoadedWorld load_world(const std::filesystem::path& path);

/// The same from memory; `file` is for messages and for the path of a table, its stem is the world's name.
sim::World parse_world(std::string_view text, const std::string& file);

LoadedWorld parse_vector_map(std::string_view text, const std::string& file);

/// Reads a world from the map of a world file or of a scenario's key `world` in `file`. Requests every key of the
/// format except `schema`; the caller calls done(). Throws PlacedError, and for a table ConfigError.
sim::World read_world(io::YamlMap& map, const std::string& default_name, const std::filesystem::path& file);

/// The world as a map that read_world() reads back to the same numbers (metres, every wall a segment). With `table`, a
/// path of wall_table(world.walls), `segments` names it.
io::YamlNode to_yaml(const sim::World& world, const std::string& table = {});

}  // namespace scanbench::study
