// Tables of walls, a CSV file that a world names instead of listing its segments.
//
//   label,x1_m,y1_m,x2_m,y2_m
//   north,0,4,6,4
//
// The first row names the columns, in any order. Coordinates are in metres. Without the column `label`, walls are
// labelled with the number of their row, from 1. A column `wall` is skipped, so that walls.csv of a recording can be
// read. The file may be compressed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/truth.hpp"

namespace scanbench::study {

/// The largest number of walls in a table: more do not fit into a scenario that lists them (kMaxYamlNodes).
inline constexpr std::size_t kMaxTableWalls = 300000;

inline constexpr std::string_view kWallLabels = "a label of 1 to 64 characters without comma, quote or line break";

/// Labels appear in CSV tables and as subjects of metrics.
bool is_wall_label(std::string_view label);

/// Throws ConfigError with file:line for unknown or missing columns, fields that are not numbers, labels that are too
/// long or occur twice, walls without length, and too many walls.
std::vector<Wall> load_wall_table(const std::filesystem::path& file);

/// The same from memory; `file` is for messages.
std::vector<Wall> parse_wall_table(std::string bytes, const std::filesystem::path& file);

/// A table that reads back to the same walls.
std::string wall_table(const std::vector<Wall>& walls);

}  // namespace scanbench::study
