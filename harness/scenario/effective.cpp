// Writes the effective scenario: all defaults are stated, and the form is canonical.
#include "harness/scenario/effective.hpp"

#include <algorithm>

#include "harness/files/hash.hpp"
#include "harness/files/placed_error.hpp"
#include "harness/files/text_file.hpp"
#include "harness/scenario/foreign_slot.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario/sections.hpp"
#include "harness/scenario/world_file.hpp"
#include "harness/yaml/reader.hpp"
#include "harness/yaml/writer.hpp"

namespace scanbench::harness {
namespace {

void add_params(YamlNode& map, const ParamSet& params) {
  for (const auto& [name, value] : params) yaml_add(map, name, to_yaml(value));
}

YamlNode choice_node(const ModuleChoice& choice, const std::string& key) {
  if (choice.source) return foreign_slot_node(choice);
  YamlNode map = yaml_map();
  yaml_add(map, key, yaml_text(choice.module));
  yaml_add(map, "params", to_yaml(choice.params));
  return map;
}

YamlNode choices_node(const std::vector<ModuleChoice>& choices) {
  YamlNode list = yaml_sequence();
  for (const auto& choice : choices) list.items.push_back(choice_node(choice, "name"));
  return list;
}

void add_input(YamlNode& root, const SimulatedInput& input, const StoredInputs& stored) {
  yaml_add(root, "world", to_yaml(input.world, stored.walls));
  YamlNode& sensor = yaml_add(root, "sensor", yaml_map());
  yaml_add(sensor, "preset", yaml_text(input.sensor_preset));
  add_params(sensor, input.sensor_params);
  YamlNode& trajectory = yaml_add(root, "trajectory", yaml_map());
  yaml_add(trajectory, "kind", yaml_text(input.trajectory.module));
  add_params(trajectory, input.trajectory.params);
  yaml_add(trajectory, "odometry", to_yaml(input.odometry_params));
  yaml_add(trajectory, "tilt", to_yaml(input.tilt_params));
  yaml_add(trajectory, "sweep", yaml_plain(input.sweep ? "true" : "false"));
  if (input.caster == sim::CasterKind::box2d) yaml_add(root, "caster", yaml_text("box2d"));
}

/// A path that begins with a variable is valid in any folder. Any other path is made absolute, because this text is
/// read from the run folder, unless the file has a copy there.
YamlNode path_node(const std::filesystem::path& path, const std::string& as_written, const std::string& stored = {}) {
  if (!stored.empty()) return yaml_text(stored);
  const bool portable = as_written.starts_with("${");
  return yaml_text(portable ? as_written : std::filesystem::absolute(path).lexically_normal().string());
}

void add_input(YamlNode& root, const RecordedInput& input, const StoredInputs&) {
  YamlNode& recording = yaml_add(root, "recording", yaml_map());
  yaml_add(recording, "log", path_node(input.log, input.log_as_written));
  yaml_add(recording, "format", yaml_text(input.format));
  if (!input.relations.empty())
    yaml_add(recording, "relations", path_node(input.relations, input.relations_as_written));
  add_params(recording, input.params);
  if (input.odometry.any()) yaml_add(recording, "odometry", to_yaml(input.odometry_params));
  YamlNode& sensor = yaml_add(root, "sensor", yaml_map());
  yaml_add(sensor, "preset", yaml_text(input.sensor_preset));
  for (const auto& spec : recorded_sensor_specs())
    yaml_add(sensor, spec.name, to_yaml(input.sensor_params.at(spec.name)));
}

void add_input(YamlNode& root, const LinesInput& input, const StoredInputs& stored) {
  if (input.world) yaml_add(root, "world", to_yaml(*input.world, stored.walls));
  YamlNode& lines = yaml_add(root, "lines", yaml_map());
  if (input.file.empty())
    add_params(lines, input.params);
  else
    yaml_add(lines, "file", path_node(input.file, input.file_as_written, stored.lines));
}

}  // namespace

std::string effective_yaml(const Scenario& scenario, const StoredInputs& stored) {
  YamlNode root = yaml_map();
  yaml_add(root, "schema", yaml_plain("1"));
  yaml_add(root, "name", yaml_text(scenario.name));
  yaml_add(root, "about", yaml_text(scenario.about));
  std::visit([&](const auto& input) { add_input(root, input, stored); }, scenario.input);
  YamlNode& seeds = yaml_add(root, "seeds", yaml_sequence());
  for (const std::uint64_t seed : scenario.seeds) seeds.items.push_back(yaml_plain(std::to_string(seed)));
  YamlNode pipelines = yaml_sequence();
  for (const auto& pipeline : scenario.pipelines) {
    YamlNode node = yaml_map();
    yaml_add(node, "name", yaml_text(pipeline.name));
    if (!pipeline.published.empty()) yaml_add(node, "published", yaml_text(pipeline.published));
    for (const auto& slot : pipeline.slots) yaml_add(node, slot.kind, choice_node(slot, "module"));
    pipelines.items.push_back(std::move(node));
  }
  if (!pipelines.items.empty()) yaml_add(root, "pipelines", std::move(pipelines));
  yaml_add(root, "metrics", choices_node(scenario.metrics));
  yaml_add(root, "figures", choices_node(scenario.figures));
  if (!scenario.published_file.empty())
    yaml_add(root, "published", path_node(scenario.published_file, scenario.published_as_written, stored.published));
  YamlNode& limits = yaml_add(root, "limits", yaml_map());
  yaml_add(limits, "seconds", yaml_number(scenario.limits.seconds));
  yaml_add(limits, "memory_mib", yaml_number(scenario.limits.memory_bytes / (1024.0 * 1024.0)));
  if (scenario.limits.sandbox) yaml_add(limits, "sandbox", yaml_plain("true"));
  return write_yaml(root);
}

namespace {

/// The name of a list's item: of a pipeline, a metric, a module.
std::string item_name(const YamlNode& item) {
  for (const char* key : {"name", "module"})
    if (const YamlNode* name = item.find(key)) return name->text;
  return "";
}

std::string shortened(std::string value) {
  constexpr std::size_t kLongest = 200;
  while (value.ends_with('\n')) value.pop_back();
  if (value.size() > kLongest) return "SHA-256 " + sha256_hex(value).substr(0, 12);
  return value.starts_with('/') ? value.substr(value.rfind('/') + 1) : value;  // two machines have different folders
}

void add_settings(const YamlNode& node, const std::string& path, std::map<std::string, std::string>& settings) {
  const std::string dot = path.empty() ? "" : path + ".";
  const bool named = node.kind == YamlKind::sequence &&
                     std::ranges::all_of(node.items, [](const YamlNode& item) { return !item_name(item).empty(); });
  if (node.kind == YamlKind::map) {
    for (const auto& entry : node.entries) add_settings(entry.value, dot + entry.key, settings);
  } else if (named) {
    for (const auto& item : node.items) add_settings(item, dot + item_name(item), settings);
  } else {
    settings[path] = shortened(node.kind == YamlKind::scalar ? node.text : write_yaml(node));
  }
}

}  // namespace

std::map<std::string, std::string> effective_settings(std::string_view text, const std::string& file) {
  std::map<std::string, std::string> settings;
  in_file(file, {}, [&] { add_settings(parse_yaml(text, kMaxWorldBytes), "", settings); });
  return settings;
}

}  // namespace scanbench::harness
