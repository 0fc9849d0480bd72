// Reads worlds from YAML and from vector maps. Every wall is checked while it is read: messages name its line and
// column.
#include "harness/study/scenario/world_file.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/shared_keys.hpp"
#include "harness/study/scenario/wall_table.hpp"

namespace scanbench::study {
namespace {

const std::string& read_label(const io::YamlNode& node, std::string_view what) {
  const std::string& label = io::read_word(node, what, kWallLabels);
  if (!is_wall_label(label))
    throw io::PlacedError(node.mark,
                          fmt::format("{} is {}; allowed: {}", what, io::quoted_excerpt(label), kWallLabels));
  return label;
}

class WorldReader {
 public:
  WorldReader(io::YamlMap& map, const std::string& default_name, const std::filesystem::path& file)
      : map_(map), file_(file) {
    world_.name = map.text_or("name", default_name);
    world_.about = map.text_or("about", "");
    ParamSpec unit;
    unit.name = "unit_m";
    unit.bounds = above(0);
    unit.unit = "m";
    if (const io::YamlNode* node = map.find("unit_m")) unit_m_ = std::get<double>(io::read_param(*node, unit));
    read_segments();
    read_chains("polylines", 2, false);
    read_chains("polygons", 3, true);
    read_circles();
    read_moving();
    read_losses();
    if (world_.walls.empty())
      throw io::PlacedError(map.mark(),
                            "the world has no walls; allowed: at least one in segments, polylines or polygons");
  }

  sim::World take() { return std::move(world_); }

 private:
  Vec2 point(const io::YamlNode& x, const io::YamlNode& y, std::string_view what) const {
    return unit_m_ * Vec2(io::read_number(x, what), io::read_number(y, what));
  }

  Vec2 point(const io::YamlNode& node, std::string_view what) const {
    const auto& xy = io::read_list(node, what, "a point, [x, y]");
    if (xy.size() != 2)
      throw io::PlacedError(node.mark, fmt::format("{} has {} numbers; allowed: 2, [x, y]", what, xy.size()));
    return point(xy[0], xy[1], what);
  }

  void add_wall(std::string label, const Segment& segment, io::Mark mark) {
    if (!(segment.length() > 0))
      throw io::PlacedError(mark, fmt::format("wall {} has no length; allowed: two different end points", label));
    const auto [first, is_new] = lines_.emplace(label, mark.line);
    if (!is_new)
      throw io::PlacedError(mark,
                            fmt::format("wall {} occurs a second time; the first is in line {}", label, first->second));
    world_.walls.push_back({std::move(label), segment});
  }

  const std::vector<io::YamlNode>* list(std::string_view key, std::string_view allowed) {
    const io::YamlNode* node = map_.find(key);
    return node == nullptr ? nullptr : &io::read_list(*node, key, allowed);
  }

  void read_segments() {
    constexpr std::string_view kRow = "[label, x1, y1, x2, y2]";
    if (const io::YamlNode* node = map_.find("segments"); node != nullptr && node->kind == io::YamlKind::map) {
      read_table(*node);
      return;
    }
    const auto* rows = list("segments", "a list of [label, x1, y1, x2, y2], or {file: TABLE}");
    if (rows == nullptr) return;
    for (const auto& row : *rows) {
      const auto& v = io::read_list(row, "a segment", kRow);
      if (v.size() != 5)
        throw io::PlacedError(row.mark, fmt::format("a segment has {} values; allowed: 5, {}", v.size(), kRow));
      add_wall(read_label(v[0], "a segment's label"), {point(v[1], v[2], "x1 or y1"), point(v[3], v[4], "x2 or y2")},
               row.mark);
    }
  }

  void read_table(const io::YamlNode& node) {
    io::YamlMap table(node, "segments");
    const io::YamlNode& path = table.require("file", "the path of a table of walls");
    const std::string as_written = table.text("file", "a path");
    table.done();
    world_.walls = load_wall_table(resolve_path(path, as_written, file_));
    if (map_.find("polylines") == nullptr && map_.find("polygons") == nullptr) return;  // nothing else has labels
    for (const Wall& wall : world_.walls) lines_.emplace(wall.label, node.mark.line);
  }

  void read_chains(std::string_view key, std::size_t least, bool closed) {
    const io::YamlNode* node = map_.find(key);
    if (node == nullptr) return;
    if (node->kind != io::YamlKind::map)
      throw io::PlacedError(
          node->mark, fmt::format("{} is {}; allowed: a map, name: [[x, y], ...]", key, io::describe_node(*node)));
    for (const auto& entry : node->entries) {
      const auto& points = io::read_list(entry.value, entry.key, "a list of points, [[x, y], ...]");
      if (points.size() < least)
        throw io::PlacedError(entry.value.mark,
                              fmt::format("{} has {} points; allowed: at least {}", entry.key, points.size(), least));
      io::YamlNode name = io::yaml_text(entry.key);
      name.mark = entry.mark;
      const std::string label = read_label(name, "a name");
      Vec2 from = point(points.front(), "a point");
      for (std::size_t i = 1; i < points.size() + (closed ? 1 : 0); ++i) {
        const io::YamlNode& to_node = points[i % points.size()];
        const Vec2 to = point(to_node, "a point");
        add_wall(fmt::format("{}.{}", label, i), {from, to}, to_node.mark);
        from = to;
      }
    }
  }

  void read_circles() {
    constexpr std::string_view kRow = "[label, x, y, radius]";
    const auto* rows = list("circles", "a list of [label, x, y, radius]");
    if (rows == nullptr) return;
    for (const auto& row : *rows) {
      const auto& v = io::read_list(row, "a circle", kRow);
      if (v.size() != 4)
        throw io::PlacedError(row.mark, fmt::format("a circle has {} values; allowed: 4, {}", v.size(), kRow));
      const double radius = unit_m_ * io::read_number(v[3], "radius");
      if (!(radius > 0))
        throw io::PlacedError(v[3].mark, fmt::format("radius is {}; allowed: a number > 0", v[3].text));
      world_.circles.push_back({read_label(v[0], "a circle's label"), point(v[1], v[2], "x or y"), radius});
    }
  }

  void read_losses() {
    const io::YamlNode* node = map_.find("losses");
    if (node == nullptr) return;
    if (node->kind != io::YamlKind::map)
      throw io::PlacedError(node->mark,
                            fmt::format("losses is {}; allowed: a map, wall: probability", io::describe_node(*node)));
    world_.losses.assign(world_.walls.size(), 0.0);
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t i = 0; i < world_.walls.size(); ++i) index.emplace(world_.walls[i].label, i);
    for (const auto& entry : node->entries) {
      const auto wall = index.find(entry.key);
      if (wall == index.end())
        throw io::PlacedError(entry.mark,
                              fmt::format("losses names a wall {}, which the world does not have; allowed: the "
                                          "label of a segment, or name.number of a polyline or polygon",
                                          io::quoted_excerpt(entry.key)));
      const double loss = io::read_number(entry.value, "a loss");
      if (!(loss >= 0 && loss <= 1))
        throw io::PlacedError(entry.value.mark, fmt::format("a loss is {}; allowed: a probability, 0 .. 1", loss));
      world_.losses[wall->second] = loss;
    }
  }

  struct MovingParams {
    double radius_m = 0.2;
    NumberRows path_m;
    double speed_mps = 1.0;
    bool loop = false;
    static auto fields() {
      return std::tuple{
          field("radius_m", &MovingParams::radius_m, above(0), "m", "radius"),
          field("path_m", &MovingParams::path_m, any_number(), "m", "points of the path"),
          field("speed_mps", &MovingParams::speed_mps, above(0), "m/s", "speed along the path"),
          field("loop", &MovingParams::loop, "true: back and forth along the path; false: stays at its last point")};
    }
  };

  void read_moving() {
    const auto* bodies = list("moving", "a list of {label, radius_m, path_m, speed_mps, loop}");
    if (bodies == nullptr) return;
    for (const auto& node : *bodies) {
      io::YamlMap body(node, "a moving body");
      const std::string label = read_label(body.require("label", "a name"), "label");
      body.require("path_m", "a list of points, [[x, y], ...]");
      const auto params = make_params<MovingParams>(body.params(param_specs<MovingParams>()));
      body.done();
      const io::YamlNode& path = *node.find("path_m");
      sim::MovingBody moving{label, params.radius_m, {}, params.speed_mps, params.loop};
      for (std::size_t i = 0; i < params.path_m.size(); ++i) {
        const auto& xy = params.path_m[i];
        if (xy.size() != 2)
          throw io::PlacedError(path.items[i].mark,
                                fmt::format("path_m[{}] has {} numbers; allowed: 2, [x, y]", i, xy.size()));
        moving.path.emplace_back(xy[0], xy[1]);
        if (i > 0 && moving.path[i] == moving.path[i - 1])
          throw io::PlacedError(path.items[i].mark, fmt::format("path_m[{}] repeats the point before it", i));
      }
      if (moving.path.size() < 2)
        throw io::PlacedError(path.mark, fmt::format("path_m has {} points; allowed: at least 2", moving.path.size()));
      world_.moving.push_back(std::move(moving));
    }
  }

  io::YamlMap& map_;
  const std::filesystem::path& file_;
  sim::World world_;
  double unit_m_ = 1.0;
  std::unordered_map<std::string, int> lines_;  // of the walls, by label
};

bool is_vector_map(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".txt") || name.ends_with(".txt.gz");
}

io::YamlNode row(std::initializer_list<double> numbers, const std::string& label) {
  io::YamlNode node = io::yaml_sequence();
  node.items.reserve(1 + numbers.size());
  node.items.push_back(io::yaml_text(label));
  for (const double v : numbers) node.items.push_back(io::yaml_number(v));
  return node;
}

// Checks the world as a whole. These errors have no line.
void validate_in_file(const sim::World& world, const std::string& file) {
  try {
    sim::validate(world);
  } catch (const ConfigError& error) {
    throw ConfigError(file + ": " + error.what());
  }
}

std::string default_name(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

}  // namespace

sim::World read_world(io::YamlMap& map, const std::string& default_name, const std::filesystem::path& file) {
  return WorldReader(map, default_name, file).take();
}

sim::World parse_world(std::string_view text, const std::string& file) {
  sim::World world = io::in_file(file, {}, [&] {
    const io::YamlNode root = io::parse_yaml(text, io::kMaxWorldBytes);
    io::YamlMap map(root, "the world file");
    read_schema(map);
    sim::World read = read_world(map, default_name(file), file);
    map.done();
    return read;
  });
  validate_in_file(world, file);
  return world;
}

LoadedWorld parse_vector_map(std::string_view text, const std::string& file) {
  LoadedWorld loaded;
  std::string name = std::filesystem::path(file).filename().string();
  loaded.world.name = name.substr(0, name.find('.'));
  io::in_file(file, {}, [&] {
    std::vector<std::string_view> fields;
    int number = 0;
    for (std::string_view rest = text; !rest.empty();) {
      const std::string_view whole = io::take_line(rest);
      const std::string_view line = whole.substr(0, whole.find('#'));
      ++number;
      io::split_fields(line, fields);
      if (fields.empty()) continue;
      const auto refuse = [&](std::string_view at, const std::string& message) {
        throw io::PlacedError({number, io::column_of(line, at)}, message + "; allowed: x1, y1, x2, y2 in metres");
      };
      if (fields.size() != 4) refuse(fields.front(), fmt::format("{} numbers in a line", fields.size()));
      double v[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const auto parsed = parse_number(fields[i]);
        if (!parsed) refuse(fields[i], io::quoted_excerpt(fields[i]) + " is not a number");
        v[i] = *parsed;
      }
      const Segment segment{{v[0], v[1]}, {v[2], v[3]}};
      if (loaded.world.walls.size() == kMaxTableWalls)
        throw io::PlacedError({number, 1}, fmt::format("more than {} walls", kMaxTableWalls));
      if (segment.length() > 0)
        loaded.world.walls.push_back({std::to_string(number), segment});
      else
        ++loaded.dropped;
    }
    if (loaded.world.walls.empty())
      throw io::PlacedError({1, 1}, "the world has no walls; allowed: at least one line with x1, y1, x2, y2");
  });
  validate_in_file(loaded.world, file);
  return loaded;
}

LoadedWorld load_world(const std::filesystem::path& path) {
  const std::string text = io::read_text_file(
      path, io::kMaxWorldBytes,
      "a world file in YAML, or a vector map (name ends in .txt or .txt.gz) with x1, y1, x2, y2 in metres "
      "per line; pictures and grid maps are not read");
  if (is_vector_map(path)) return parse_vector_map(text, path.string());
  return {parse_world(text, path.string())};
}

io::YamlNode to_yaml(const sim::World& world, const std::string& table) {
  io::YamlNode map = io::yaml_map();
  io::yaml_add(map, "name", io::yaml_text(world.name));
  if (!world.about.empty()) io::yaml_add(map, "about", io::yaml_text(world.about));
  io::YamlNode& segments = io::yaml_add(map, "segments", table.empty() ? io::yaml_sequence() : io::yaml_map());
  if (table.empty()) {
    segments.items.reserve(world.walls.size());
    for (const auto& wall : world.walls)
      segments.items.push_back(
          row({wall.segment.a.x(), wall.segment.a.y(), wall.segment.b.x(), wall.segment.b.y()}, wall.label));
  } else {
    io::yaml_add(segments, "file", io::yaml_text(table));
  }
  if (!world.losses.empty()) {
    io::YamlNode& losses = io::yaml_add(map, "losses", io::yaml_map());
    for (std::size_t i = 0; i < world.losses.size(); ++i)
      if (world.losses[i] > 0) io::yaml_add(losses, world.walls[i].label, io::yaml_number(world.losses[i]));
  }
  if (!world.circles.empty()) {
    io::YamlNode& circles = io::yaml_add(map, "circles", io::yaml_sequence());
    for (const auto& c : world.circles) circles.items.push_back(row({c.center.x(), c.center.y(), c.radius_m}, c.label));
  }
  if (!world.moving.empty()) {
    io::YamlNode& moving = io::yaml_add(map, "moving", io::yaml_sequence());
    for (const auto& body : world.moving) {
      io::YamlNode node = io::yaml_map();
      io::yaml_add(node, "label", io::yaml_text(body.label));
      io::yaml_add(node, "radius_m", io::yaml_number(body.radius_m));
      NumberRows path;
      for (const auto& p : body.path) path.push_back({p.x(), p.y()});
      io::yaml_add(node, "path_m", io::to_yaml(ParamValue(path)));
      io::yaml_add(node, "speed_mps", io::yaml_number(body.speed_mps));
      io::yaml_add(node, "loop", io::yaml_plain(body.loop ? "true" : "false"));
      moving.items.push_back(std::move(node));
    }
  }
  return map;
}

}  // namespace scanbench::study
