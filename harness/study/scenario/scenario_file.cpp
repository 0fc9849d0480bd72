// Reads the sections of a scenario file and checks how they fit each other.
#include "harness/study/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/io/exchange/log.hpp"
#include "harness/io/files/input_file.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/io/yaml/sets.hpp"
#include "harness/study/catalog/find_module.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/line_set.hpp"
#include "harness/study/scenario/published.hpp"
#include "harness/study/scenario/sections.hpp"
#include "harness/study/scenario/shared_keys.hpp"
#include "harness/study/scenario/world_file.hpp"
#include "sim/sensors.hpp"
#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace scanbench::study {
namespace {

/// Error of the readings of a log whose scenario states no sensor; most scanners have 1 to 3 cm.
constexpr double kUnknownSigmaM = 0.01;

class ScenarioReader {
 public:
  ScenarioReader(const io::YamlNode& root, Scenario& scenario, bool is_recorded)
      : root_(root), map_(root, "the scenario"), scenario_(scenario), is_recorded_(is_recorded) {}

  void read() {
    read_schema(map_);
    scenario_.name = map_.text_or("name", scenario_.path.stem().string());
    const io::YamlNode* name = map_.find("name");
    require_folder_name(scenario_.name, name != nullptr ? name->mark : root_.mark, "the scenario's name");
    scenario_.about = map_.text_or("about", "");
    read_limits();
    scenario_.seeds = read_seeds(map_);
    if (const io::YamlNode* recording = map_.find("recording"))
      read_recorded(*recording);
    else if (const io::YamlNode* lines = map_.find("lines"))
      read_lines(*lines);
    else
      read_simulated();
    if (scenario_.seeds.empty()) scenario_.seeds = {1};
    const bool scans = !std::holds_alternative<LinesInput>(scenario_.input);
    ModuleSources sources{.file = scenario_.path, .is_recorded = is_recorded_, .sandbox = scenario_.limits.sandbox};
    sources.libraries = read_plugins(map_, sources);
    if (const io::YamlNode* node = map_.find("pipelines")) scenario_.pipelines = read_pipelines(*node, scans, sources);
    if (const io::YamlNode* node = map_.find("metrics")) scenario_.metrics = read_choices(*node, "metrics");
    if (const io::YamlNode* node = map_.find("figures")) {
      scenario_.figures = read_choices(*node, "figure");
      check_figure_pipelines(*node, scenario_.figures, scenario_.pipelines);
    }
    if (const io::YamlNode* node = map_.find("published")) {
      scenario_.published_as_written = map_.text("published", "a file's path");
      scenario_.published_file = resolve_path(*node, scenario_.published_as_written, scenario_.path);
      check_published(scenario_);
    }
    map_.done();
  }

 private:
  /// Reads an optional section that has only parameters; missing ones get their defaults. Angles are in degrees, as in
  /// the file.
  template <class Params>
  static ParamSet read_optional(io::YamlMap& map, const std::string& key) {
    const std::vector<ParamSpec> specs = param_specs<Params>();
    const io::YamlNode* node = map.find(key);
    if (node == nullptr) return resolve(specs, {});
    io::YamlMap section(*node, key);
    ParamSet params = resolve(specs, section.params(specs));
    section.done();
    return params;
  }

  void read_limits() {
    const auto params = make_params<LimitParams>(read_optional<LimitParams>(map_, "limits"));
    scenario_.limits = {params.seconds, params.memory_mib * 1024.0 * 1024.0, params.sandbox};
  }

  void read_simulated() {
    SimulatedInput input;
    input.world = read_world_section(map_.require(
        "world", "{file: PATH}, or the keys of a world file; or recording: {log: FILE, ...}; or lines: {file: FILE}"));
    const io::YamlNode& sensor = map_.require("sensor", "{preset: NAME}, and any field that overrides the preset");
    read_sensor(sensor, sim::sensor_param_specs(), input.sensor_preset, input.sensor_params, input.sensor);
    read_trajectory(map_.require("trajectory", "{kind: NAME, ...}"), input);
    read_caster(input);
    scenario_.input = std::move(input);
  }

  void read_caster(SimulatedInput& input) {
    const io::YamlNode* node = map_.find("caster");
    if (node == nullptr) return;
    const std::string name = map_.text("caster", "exact or box2d");
    if (name != "exact" && name != "box2d")
      throw io::PlacedError(node->mark, fmt::format("caster is '{}'; allowed: exact, box2d", name));
    input.caster = name == "box2d" ? sim::CasterKind::box2d : sim::CasterKind::exact;
  }

  sim::World read_world_section(const io::YamlNode& node) {
    io::YamlMap map(node, "world");
    const io::YamlNode* file = map.find("file");
    if (file == nullptr) {
      sim::World world = read_world(map, scenario_.name, scenario_.path);
      map.done();
      at_param(node, [&] { sim::validate(world); });
      return world;
    }
    const std::string as_written = map.text("file", "a path");
    map.done();
    LoadedWorld loaded = load_world(resolve_path(*file, as_written, scenario_.path));
    if (loaded.dropped > 0)
      scenario_.notes.push_back(fmt::format("{}: skipped {} segments without length", as_written, loaded.dropped));
    return std::move(loaded.world);
  }

  static void read_sensor(const io::YamlNode& node, const std::vector<ParamSpec>& specs, std::string& preset,
                          ParamSet& effective, SensorModel& sensor) {
    io::YamlMap map(node, "sensor");
    preset = map.text_or("preset", "custom");
    const ParamSet overrides = map.params(specs);
    map.done();
    const bool known = sim::sensor_presets().contains(preset);
    const io::YamlNode* preset_node = node.find("preset");
    at_param(known || preset_node == nullptr ? node : *preset_node,
             [&] { sensor = sim::make_sensor(preset, overrides, &effective); });
  }

  static void read_trajectory(const io::YamlNode& node, SimulatedInput& input) {
    io::YamlMap map(node, "trajectory");
    const io::YamlNode& kind_node =
        map.require("kind", fmt::format("one of {}", fmt::join(module_names("trajectory"), ", ")));
    const std::string kind = map.text("kind", "a name");
    const auto entry = at_param(kind_node, [&] { return find_module("trajectory", kind); });
    input.odometry_params = read_optional<sim::OdometryNoise>(map, "odometry");
    input.odometry = make_params<sim::OdometryNoise>(input.odometry_params);
    input.tilt_params = read_optional<sim::Tilt>(map, "tilt");
    input.tilt = make_params<sim::Tilt>(input.tilt_params);
    ParamSpec sweep;
    sweep.name = "sweep";
    sweep.type = ParamType::boolean;
    if (const io::YamlNode* sweep_node = map.find("sweep")) {
      input.sweep = std::get<bool>(io::read_param(*sweep_node, sweep));
      if (input.sweep && !(input.sensor.time_per_beam_s > 0))
        throw io::PlacedError(
            sweep_node->mark,
            "sweep is true, but the sensor's time_per_beam_s is 0; allowed: a sensor with time_per_beam_s > 0");
    }
    input.trajectory = {"trajectory", kind, map.params(entry.params)};
    map.done();
    input.trajectory.params = resolve(entry.params, input.trajectory.params);
    at_param(node, [&] {
      Registry<sim::TrajectoryKind>::make(kind, input.trajectory.params)->generate(input.sensor.scan_period_s);
    });
  }

  void read_recorded(const io::YamlNode& node) {
    refuse_beside("recording", {"lines", "world", "trajectory"}, "a recording, or world, sensor and trajectory");
    RecordedInput input;
    io::YamlMap map(node, "recording");
    const io::YamlNode& log = map.require("log", "a file's path");
    input.log_as_written = map.text("log", "a file's path");
    const io::YamlNode& format_node =
        map.require("format", fmt::format("one of {}", fmt::join(io::log_formats(), ", ")));
    input.format = map.text("format", "a name");
    const auto specs = at_param(format_node, [&] { return io::log_param_specs(input.format); });
    for (const auto& name : io::required_log_params(input.format))
      map.require(name, "the reading in m that means nothing in range, as do all greater ones; 0 if there is none");
    const io::YamlNode* relations = map.find("relations");
    if (relations != nullptr) input.relations_as_written = map.text("relations", "a file's path");
    input.odometry_params = read_optional<sim::OdometryNoise>(map, "odometry");
    input.odometry = make_params<sim::OdometryNoise>(input.odometry_params);
    input.params = resolve(specs, map.params(specs));
    map.done();
    at_param(node, [&] { io::check_log_params(input.format, input.params); });
    const auto at_most = [](const std::filesystem::path& file, double bytes) {
      io::InputFile(file).require_at_most(static_cast<std::uint64_t>(bytes));
    };
    input.log = resolve_path(log, input.log_as_written, scenario_.path, is_recorded_);
    if (!is_recorded_) at_param(log, [&] { at_most(input.log, scenario_.limits.memory_bytes); });
    if (relations != nullptr) {
      input.relations = resolve_path(*relations, input.relations_as_written, scenario_.path, is_recorded_);
      if (!is_recorded_) at_param(*relations, [&] { at_most(input.relations, io::kMaxWorldBytes); });
    }
    if (const io::YamlNode* sensor = map_.find("sensor")) {
      read_sensor(*sensor, recorded_sensor_specs(), input.sensor_preset, input.sensor_params, input.sensor);
    } else {
      input.sensor_preset = "custom";
      input.sensor = sim::make_sensor("custom", {{"sigma_m", kUnknownSigmaM}}, &input.sensor_params);
      scenario_.notes.push_back(
          fmt::format("there is no `sensor`: its readings are taken to have errors of {:g} m. sensor: {{preset: NAME}} "
                      "or sensor: {{sigma_m: X}} states them; `scanbench list sensor` has the names",
                      kUnknownSigmaM));
    }
    if (!input.odometry.any()) refuse_many_seeds("a recorded log without errors of `odometry`");
    scenario_.input = std::move(input);
  }

  void read_lines(const io::YamlNode& node) {
    refuse_beside("lines", {"sensor", "trajectory"}, "lines and world, or world, sensor and trajectory");
    LinesInput input;
    io::YamlMap map(node, "lines");
    if (const io::YamlNode* file = map.find("file")) {
      input.file_as_written = map.text("file", "a path");
      map.done();
      input.file = resolve_path(*file, input.file_as_written, scenario_.path);
      input.file_name = input.file.filename().string();
      input.frames = load_line_set(input.file);
      refuse_many_seeds("a file of lines");
      if (const io::YamlNode* world = map_.find("world")) input.world = read_world_section(*world);
    } else {
      input.params = map.params(param_specs<sim::LineCopies>());
      map.done();
      input.copies = make_params<sim::LineCopies>(input.params);
      input.world = read_world_section(
          map_.require("world", "{file: PATH}, or the keys of a world file: the walls that are copied"));
    }
    scenario_.input = std::move(input);
  }

  void refuse_beside(std::string_view what, std::initializer_list<const char*> others, std::string_view allowed) {
    for (const char* key : others)
      if (const io::YamlNode* other = map_.find(key))
        throw io::PlacedError(other->mark, fmt::format("both {} and {}; allowed: {}", what, key, allowed));
  }

  void refuse_many_seeds(std::string_view what) {
    if (scenario_.seeds.size() > 1)
      throw io::PlacedError(map_.find("seeds")->mark,
                            fmt::format("seeds has {} values, but {} is the same for every seed; allowed: one seed",
                                        scenario_.seeds.size(), what));
  }

  const io::YamlNode& root_;
  io::YamlMap map_;
  Scenario& scenario_;
  bool is_recorded_;  ///< the run folder holds what the log says
};

Scenario parse(std::string_view text, const std::filesystem::path& path, const std::vector<std::string>& sets,
               bool is_recorded) {
  Scenario scenario;
  scenario.path = path;
  scenario.text = text;
  io::in_file(path.string(), sets, [&] {
    // The larger limit applies, because a scenario may contain its world.
    io::YamlNode root = io::parse_yaml(text, io::kMaxWorldBytes);
    scenario.begin = root.mark;
    io::apply_sets(root, sets);
    ScenarioReader(root, scenario, is_recorded).read();
  });
  return scenario;
}

}  // namespace

Scenario parse_scenario(std::string_view text, const std::filesystem::path& path,
                        const std::vector<std::string>& sets) {
  return parse(text, path, sets, false);
}

Scenario load_scenario(const std::filesystem::path& path, const std::vector<std::string>& sets) {
  return parse_scenario(io::read_text_file(path, io::kMaxWorldBytes), path, sets);
}

Scenario load_recorded_scenario(const std::filesystem::path& path) {
  return parse(io::read_text_file(path, io::kMaxWorldBytes), path, {}, true);
}

}  // namespace scanbench::study
