// Writes the effective scenario: all defaults are stated, and the form is canonical.
#include "harness/study/scenario/effective.hpp"

#include <algorithm>

#include "harness/io/files/hash.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/foreign_slot.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/sections.hpp"
#include "harness/study/scenario/world_file.hpp"

namespace scanbench::study {
namespace {

void add_params(io::YamlNode& map, const ParamSet& params) {
  for (const auto& [name, value] : params) io::yaml_add(map, name, io::to_yaml(value));
}

io::YamlNode choice_node(const ModuleChoice& choice, const std::string& key) {
  if (choice.source) return foreign_slot_node(choice);
  io::YamlNode map = io::yaml_map();
  io::yaml_add(map, key, io::yaml_text(choice.module));
  io::yaml_add(map, "params", io::to_yaml(choice.params));
  return map;
}

io::YamlNode choices_node(const std::vector<ModuleChoice>& choices) {
  io::YamlNode list = io::yaml_sequence();
  for (const auto& choice : choices) list.items.push_back(choice_node(choice, "name"));
  return list;
}

void add_input(io::YamlNode& root, const SimulatedInput& input, const StoredInputs& stored) {
  io::yaml_add(root, "world", to_yaml(input.world, stored.walls));
  io::YamlNode& sensor = io::yaml_add(root, "sensor", io::yaml_map());
  io::yaml_add(sensor, "preset", io::yaml_text(input.sensor_preset));
  add_params(sensor, input.sensor_params);
  io::YamlNode& trajectory = io::yaml_add(root, "trajectory", io::yaml_map());
  io::yaml_add(trajectory, "kind", io::yaml_text(input.trajectory.module));
  add_params(trajectory, input.trajectory.params);
  io::yaml_add(trajectory, "odometry", io::to_yaml(input.odometry_params));
  io::yaml_add(trajectory, "tilt", io::to_yaml(input.tilt_params));
  io::yaml_add(trajectory, "sweep", io::yaml_plain(input.sweep ? "true" : "false"));
  if (input.caster == sim::CasterKind::box2d) io::yaml_add(root, "caster", io::yaml_text("box2d"));
}

/// A path that begins with a variable is valid in any folder. Any other path is made absolute, because this text is
/// read from the run folder, unless the file has a copy there.
io::YamlNode path_node(const std::filesystem::path& path, const std::string& as_written,
                       const std::string& stored = {}) {
  if (!stored.empty()) return io::yaml_text(stored);
  const bool portable = as_written.starts_with("${");
  return io::yaml_text(portable ? as_written : std::filesystem::absolute(path).lexically_normal().string());
}

void add_input(io::YamlNode& root, const RecordedInput& input, const StoredInputs&) {
  io::YamlNode& recording = io::yaml_add(root, "recording", io::yaml_map());
  io::yaml_add(recording, "log", path_node(input.log, input.log_as_written));
  io::yaml_add(recording, "format", io::yaml_text(input.format));
  if (!input.relations.empty())
    io::yaml_add(recording, "relations", path_node(input.relations, input.relations_as_written));
  add_params(recording, input.params);
  if (input.odometry.any()) io::yaml_add(recording, "odometry", io::to_yaml(input.odometry_params));
  io::YamlNode& sensor = io::yaml_add(root, "sensor", io::yaml_map());
  io::yaml_add(sensor, "preset", io::yaml_text(input.sensor_preset));
  for (const auto& spec : recorded_sensor_specs())
    io::yaml_add(sensor, spec.name, io::to_yaml(input.sensor_params.at(spec.name)));
}

void add_input(io::YamlNode& root, const LinesInput& input, const StoredInputs& stored) {
  if (input.world) io::yaml_add(root, "world", to_yaml(*input.world, stored.walls));
  io::YamlNode& lines = io::yaml_add(root, "lines", io::yaml_map());
  if (input.file.empty())
    add_params(lines, input.params);
  else
    io::yaml_add(lines, "file", path_node(input.file, input.file_as_written, stored.lines));
}

}  // namespace

std::string effective_yaml(const Scenario& scenario, const StoredInputs& stored) {
  io::YamlNode root = io::yaml_map();
  io::yaml_add(root, "schema", io::yaml_plain("1"));
  io::yaml_add(root, "name", io::yaml_text(scenario.name));
  io::yaml_add(root, "about", io::yaml_text(scenario.about));
  std::visit([&](const auto& input) { add_input(root, input, stored); }, scenario.input);
  io::YamlNode& seeds = io::yaml_add(root, "seeds", io::yaml_sequence());
  for (const std::uint64_t seed : scenario.seeds) seeds.items.push_back(io::yaml_plain(std::to_string(seed)));
  io::YamlNode pipelines = io::yaml_sequence();
  for (const auto& pipeline : scenario.pipelines) {
    io::YamlNode node = io::yaml_map();
    io::yaml_add(node, "name", io::yaml_text(pipeline.name));
    if (!pipeline.published.empty()) io::yaml_add(node, "published", io::yaml_text(pipeline.published));
    for (const auto& slot : pipeline.slots) io::yaml_add(node, slot.kind, choice_node(slot, "module"));
    pipelines.items.push_back(std::move(node));
  }
  if (!pipelines.items.empty()) io::yaml_add(root, "pipelines", std::move(pipelines));
  io::yaml_add(root, "metrics", choices_node(scenario.metrics));
  io::yaml_add(root, "figures", choices_node(scenario.figures));
  if (!scenario.published_file.empty())
    io::yaml_add(root, "published",
                 path_node(scenario.published_file, scenario.published_as_written, stored.published));
  io::YamlNode& limits = io::yaml_add(root, "limits", io::yaml_map());
  io::yaml_add(limits, "seconds", io::yaml_number(scenario.limits.seconds));
  io::yaml_add(limits, "memory_mib", io::yaml_number(scenario.limits.memory_bytes / (1024.0 * 1024.0)));
  if (scenario.limits.sandbox) io::yaml_add(limits, "sandbox", io::yaml_plain("true"));
  return io::write_yaml(root);
}

namespace {

/// The name of a list's item: of a pipeline, a metric, a module.
std::string item_name(const io::YamlNode& item) {
  for (const char* key : {"name", "module"})
    if (const io::YamlNode* name = item.find(key)) return name->text;
  return "";
}

std::string shortened(std::string value) {
  constexpr std::size_t kLongest = 200;
  while (value.ends_with('\n')) value.pop_back();
  if (value.size() > kLongest) return "SHA-256 " + io::sha256_hex(value).substr(0, 12);
  return value.starts_with('/') ? value.substr(value.rfind('/') + 1) : value;  // two machines have different folders
}

void add_settings(const io::YamlNode& node, const std::string& path, std::map<std::string, std::string>& settings) {
  const std::string dot = path.empty() ? "" : path + ".";
  const bool named = node.kind == io::YamlKind::sequence &&
                     std::ranges::all_of(node.items, [](const io::YamlNode& item) { return !item_name(item).empty(); });
  if (node.kind == io::YamlKind::map) {
    for (const auto& entry : node.entries) add_settings(entry.value, dot + entry.key, settings);
  } else if (named) {
    for (const auto& item : node.items) add_settings(item, dot + item_name(item), settings);
  } else {
    settings[path] = shortened(node.kind == io::YamlKind::scalar ? node.text : io::write_yaml(node));
  }
}

}  // namespace

std::map<std::string, std::string> effective_settings(std::string_view text, const std::string& file) {
  std::map<std::string, std::string> settings;
  io::in_file(file, {}, [&] { add_settings(io::parse_yaml(text, io::kMaxWorldBytes), "", settings); });
  return settings;
}

}  // namespace scanbench::study
