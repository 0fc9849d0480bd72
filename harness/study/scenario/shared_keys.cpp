// Reads the schema, seeds, pipelines, lists of metrics and figures, and paths.
#include "harness/study/scenario/shared_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/study/catalog/chain.hpp"
#include "harness/study/catalog/find_module.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::study {
namespace {

ParamSpec seed_spec(std::string name, Bounds bounds) {
  ParamSpec spec;
  spec.name = std::move(name);
  spec.type = ParamType::integer;
  spec.bounds = bounds;
  return spec;
}

std::uint64_t read_seed(const io::YamlNode& node, const std::string& name) {
  return static_cast<std::uint64_t>(
      std::get<std::int64_t>(io::read_param(node, seed_spec(name, between(0, static_cast<double>(kLargestSeed))))));
}

// Reads a map {key: name, params: {...}}. Other keys are refused.
ModuleChoice read_module(const io::YamlNode& node, const std::string& kind, const std::string& key,
                         const std::string& what) {
  io::YamlMap map(node, what);
  const io::YamlNode& name_node = map.require(key, fmt::format("one of {}", fmt::join(module_names(kind), ", ")));
  const std::string name = map.text(key, "a name");
  ModuleChoice choice{kind, name, {}};
  const auto entry = at_param(name_node, [&] { return find_module(kind, name); });
  if (const io::YamlNode* params_node = map.find("params")) {
    io::YamlMap params(*params_node, "params of " + name);
    choice.params = params.params(entry.params);
    params.done();
    at_param(*params_node, [&] { try_module(kind, name, choice.params); });
  } else {
    at_param(node, [&] { try_module(kind, name, {}); });
  }
  map.done();
  choice.params = resolve(entry.params, choice.params);
  return choice;
}

/// The node that has the parameters of a slot, else the slot itself.
const io::YamlNode& params_node(const io::YamlNode& slot) {
  const io::YamlNode* params = slot.find("params");
  return params != nullptr && params->kind == io::YamlKind::map ? *params : slot;
}

PipelineSpec read_pipeline(const io::YamlNode& node, bool scans, const ModuleSources& sources) {
  io::YamlMap map(node, "a pipeline");
  PipelineSpec pipeline;
  pipeline.name = map.text("name", "a name for tables and figures");
  require_folder_name(pipeline.name, map.find("name")->mark, "the pipeline's name");
  pipeline.published = map.text_or("published", "");
  std::vector<io::Mark> marks;
  for (const SlotKind& slot : chain_slots()) {
    const io::YamlNode* slot_node = map.find(slot.kind);
    if (slot_node == nullptr) continue;
    marks.push_back(slot_node->mark);
    if (slot_node->kind != io::YamlKind::map)
      throw io::PlacedError(
          slot_node->mark,
          fmt::format("{} of {} is {}; allowed: {{module: NAME}} or {{module: NAME, params: {{key: value}}}}, "
                      "or {{program: [WORD, ...]}}",
                      slot.kind, pipeline.name, io::describe_node(*slot_node)));
    const std::string kind(slot.kind);
    const std::string what = fmt::format("{} of {}", slot.kind, pipeline.name);
    const bool foreign = is_foreign_slot(*slot_node, kind, sources);
    pipeline.slots.push_back(
        foreign ? at_param(params_node(*slot_node), [&] { return read_foreign_slot(*slot_node, kind, what, sources); })
                : read_module(*slot_node, kind, "module", what));
  }
  map.done();
  if (const auto fault = chain_fault(pipeline, scans))
    throw io::PlacedError(fault->slot < marks.size() ? marks[fault->slot] : node.mark, fault->message);
  return pipeline;
}

}  // namespace

void read_schema(io::YamlMap& map) {
  ParamSpec spec;
  spec.name = "schema";
  spec.type = ParamType::integer;
  spec.bounds = between(1, 1);
  io::read_param(map.require("schema", "schema: 1, the version of the format"), spec);
}

std::vector<std::uint64_t> read_seeds(io::YamlMap& map) {
  const io::YamlNode* one = map.find("seed");
  const io::YamlNode* many = map.find("seeds");
  if (one != nullptr && many != nullptr) throw io::PlacedError(many->mark, "both seed and seeds; allowed: one of them");
  if (one != nullptr) return {read_seed(*one, "seed")};
  if (many == nullptr) return {};
  std::vector<std::uint64_t> seeds;
  if (many->kind == io::YamlKind::map) {
    io::YamlMap range(*many, "seeds");
    const std::uint64_t first = read_seed(range.require("first", "a seed"), "first");
    const auto count = std::get<std::int64_t>(io::read_param(
        range.require("count", "how many seeds"), seed_spec("count", between(1, static_cast<double>(kMostSeeds)))));
    range.done();
    if (const std::uint64_t last = first + static_cast<std::uint64_t>(count) - 1; last > kLargestSeed)
      throw io::PlacedError(many->mark,
                            fmt::format("the last of these seeds is {}; allowed: up to {}", last, kLargestSeed));
    for (std::int64_t i = 0; i < count; ++i) seeds.push_back(first + static_cast<std::uint64_t>(i));
    return seeds;
  }
  std::set<std::uint64_t> seen;
  const auto& nodes = io::read_list(*many, "seeds", "a list, [1, 2, 3], or {first: 1, count: 20}");
  if (nodes.size() > kMostSeeds)
    throw io::PlacedError(many->mark, fmt::format("seeds has {} values; allowed: up to {}", nodes.size(), kMostSeeds));
  for (const auto& node : nodes) {
    seeds.push_back(read_seed(node, "a seed"));
    if (!seen.insert(seeds.back()).second)
      throw io::PlacedError(node.mark, fmt::format("the seed {} occurs a second time", seeds.back()));
  }
  if (seeds.empty()) throw io::PlacedError(many->mark, "seeds is empty; allowed: at least one");
  return seeds;
}

std::vector<PipelineSpec> read_pipelines(const io::YamlNode& node, bool scans, const ModuleSources& sources) {
  std::vector<PipelineSpec> pipelines;
  std::set<std::string> names;
  for (const auto& item : io::read_list(node, "pipelines", "a list of {name, extract, ...}")) {
    pipelines.push_back(read_pipeline(item, scans, sources));
    if (!names.insert(pipelines.back().name).second)
      throw io::PlacedError(
          item.mark, fmt::format("a second pipeline is called {}; allowed: different names", pipelines.back().name));
  }
  if (pipelines.empty()) throw io::PlacedError(node.mark, "pipelines is empty; allowed: at least one pipeline");
  return pipelines;
}

std::vector<ModuleChoice> read_choices(const io::YamlNode& node, const std::string& kind) {
  const std::string list = kind == "figure" ? "figures" : kind;
  std::vector<ModuleChoice> choices;
  for (const auto& item : io::read_list(node, list, "a list of names or of {name, params}")) {
    if (item.kind == io::YamlKind::scalar) {
      const auto entry = at_param(item, [&] { return find_module(kind, item.text); });
      choices.push_back({kind, item.text, resolve(entry.params, {})});
    } else {
      choices.push_back(read_module(item, kind, "name", "an element of " + list));
    }
    if (std::ranges::count(choices, choices.back().module, &ModuleChoice::module) > 1)
      throw io::PlacedError(item.mark, fmt::format("{} occurs in {} a second time", choices.back().module, list));
  }
  return choices;
}

void require_folder_name(const std::string& name, io::Mark mark, const std::string& what) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == '-' ||
      !std::ranges::all_of(name, good))
    throw io::PlacedError(
        mark, fmt::format("{} is {}; allowed: 1 to 100 letters, digits, _ - and ., not beginning with - or .", what,
                          io::quoted_excerpt(name)));
}

std::filesystem::path resolve_path(const io::YamlNode& node, const std::string& text, const std::filesystem::path& file,
                                   bool may_be_absent) {
  constexpr std::string_view kVariable = "${SCANBENCH_DATA}";
  std::string expanded = text;
  if (const std::size_t at = expanded.find(kVariable); at != std::string::npos) {
    const char* value = std::getenv("SCANBENCH_DATA");
    const bool is_set = value != nullptr && *value != '\0';
    if (!is_set && may_be_absent) return text;
    if (!is_set)
      throw io::PlacedError(node.mark,
                            "${SCANBENCH_DATA} is not set; set that environment variable to the folder that holds the "
                            "data sets, or write the path out");
    expanded.replace(at, kVariable.size(), value);
  }
  if (expanded.find("${") != std::string::npos)
    throw io::PlacedError(node.mark,
                          io::quoted_excerpt(text) + " names a variable; allowed: ${SCANBENCH_DATA} and no other");
  const std::filesystem::path path(expanded);
  // As for the shell, a path on the command line is relative to the working directory.
  const bool from_command_line = node.mark.line == 0;
  std::filesystem::path result = path.is_absolute() || from_command_line ? path : file.parent_path() / path;
  std::error_code error;
  if (!may_be_absent && !std::filesystem::exists(result, error))
    throw io::PlacedError(node.mark, "no such file: " + result.string());
  return result;
}

}  // namespace scanbench::study
