// Reads a set of lines that are merged without scans.
//
//   frame,x1_m,y1_m,x2_m,y2_m
//   0,0,0,4,0
//   1,0.1,0.02,3.9,0.01
//
// The first row names the columns, in any order: x1_m y1_m x2_m y2_m in one common frame, and, optionally, `frame`: the
// scan that a line comes from, numbered 0, 1, 2, ... in this order (without it all lines belong to one scan). The
// columns line, members and points are skipped, so that map.csv of a run can be read. Commas or blanks separate, #
// begins a comment.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.hpp"
#include "sim/world.hpp"

namespace scanbench::study {

/// Lines by frame. Throws ConfigError with file:line:col for columns that are missing, unknown or named twice, fields
/// that are missing or no numbers, frames out of order, lines without length, and no line at all.
std::vector<std::vector<Segment>> load_line_set(const std::filesystem::path& path);

/// The same from memory; `file` is for messages.
std::vector<std::vector<Segment>> parse_line_set(std::string_view text, const std::string& file);

/// Frames without beams that hold the lines; their poses are the origin. `world` is the truth; may be nullptr.
Recording line_set_recording(const std::vector<std::vector<Segment>>& frames, const sim::World* world);

}  // namespace scanbench::study
