// Reads and writes tables of walls.
#include "harness/study/scenario/wall_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/csv_rows.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/gate.hpp"
#include "harness/io/yaml/writer.hpp"
#include "sim/label_set.hpp"

namespace scanbench::study {
namespace {

constexpr std::array<const char*, 4> kEndColumns = {"x1_m", "y1_m", "x2_m", "y2_m"};
constexpr std::string_view kTableColumns = "x1_m, y1_m, x2_m, y2_m, and label, wall";

enum class WallField { x1, y1, x2, y2, label, skipped };

/// What each column of the table holds.
std::vector<WallField> wall_fields(const io::CsvRows& rows) {
  const auto refuse = [&](const std::string& message) {
    rows.refuse(1, fmt::format("{}; allowed in the first row: {}", message, kTableColumns));
  };
  std::vector<WallField> fields;
  for (const std::string& name : rows.columns()) {
    if (std::ranges::count(rows.columns(), name) > 1)
      refuse(fmt::format("two columns are called {}", io::quoted_excerpt(name)));
    const auto* const end = std::ranges::find(kEndColumns, name);
    if (end == kEndColumns.end() && name != "label" && name != "wall")
      refuse("unknown column " + io::quoted_excerpt(name));
    fields.push_back(end != kEndColumns.end() ? static_cast<WallField>(end - kEndColumns.begin())
                     : name == "label"        ? WallField::label
                                              : WallField::skipped);
  }
  return fields;
}

/// Characters beyond ASCII must be text for YAML too, because effective scenarios list walls.
bool is_yaml_text(std::string_view label) {
  if (std::ranges::all_of(label, [](char c) { return c >= 0; })) return true;
  io::YamlNode map = io::yaml_map();
  io::yaml_add(map, "label", io::yaml_text(std::string(label)));
  try {
    return io::parse_yaml(io::write_yaml(map), io::kMaxWorldBytes).find("label")->text == label;
  } catch (const ConfigError&) {
    return false;
  }
}

}  // namespace

bool is_wall_label(std::string_view label) {
  const auto bad = [](char c) { return c == ',' || c == '"' || (c >= 0 && c < ' ') || c == 127; };
  return !label.empty() && label.size() <= 64 && std::ranges::none_of(label, bad);
}

std::vector<Wall> parse_wall_table(std::string bytes, const std::filesystem::path& file) {
  io::CsvRows rows(bytes, file, {kEndColumns.begin(), kEndColumns.end()});
  const std::vector<WallField> fields = wall_fields(rows);
  const bool has_labels = std::ranges::count(fields, WallField::label) > 0;
  const auto most = static_cast<std::size_t>(std::ranges::count(bytes, '\n'));  // one more if the last line has no end
  std::vector<Wall> walls;
  std::vector<std::size_t> lines;  // of the walls
  walls.reserve(std::min(most, kMaxTableWalls));
  lines.reserve(walls.capacity());
  while (rows.next()) {
    if (walls.size() == kMaxTableWalls) rows.refuse(rows.line(), fmt::format("more than {} walls", kMaxTableWalls));
    Wall& wall = walls.emplace_back();
    std::array<double, 4> ends{};
    for (const WallField field : fields) {
      if (field < WallField::label)
        ends[static_cast<std::size_t>(field)] = rows.number();
      else if (field == WallField::label)
        wall.label = rows.text();
      else
        rows.text();
    }
    lines.push_back(rows.line());
    wall.segment = {{ends[0], ends[1]}, {ends[2], ends[3]}};
    if (!(wall.segment.length() > 0))
      rows.refuse(rows.line(), "a wall without length; allowed: two different end points");
    if (!has_labels) wall.label = std::to_string(walls.size());
    if (!is_wall_label(wall.label) || !is_yaml_text(wall.label))
      rows.refuse(rows.line(), fmt::format("label is {}; allowed: {}", io::quoted_excerpt(wall.label), kWallLabels));
  }
  sim::LabelSet known(walls.size());  // in a loop of its own, whose misses of the cache overlap
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (!known.insert(walls[i].label))
      rows.refuse(lines[i], fmt::format("wall {} occurs a second time", io::quoted_excerpt(walls[i].label)));
  return walls;
}

std::vector<Wall> load_wall_table(const std::filesystem::path& file) {
  return parse_wall_table(io::read_text_file(file, io::kMaxWorldBytes, fmt::format("a table with {}", kTableColumns)),
                          file);
}

std::string wall_table(const std::vector<Wall>& walls) {
  io::CsvWriter csv({"label", kEndColumns[0], kEndColumns[1], kEndColumns[2], kEndColumns[3]});
  for (const Wall& wall : walls) {
    const auto& [a, b] = wall.segment;
    csv.text(wall.label).number(a.x()).number(a.y()).number(b.x()).number(b.y());
    csv.end_row();
  }
  return csv.str();
}

}  // namespace scanbench::study
