// Seeds, pipelines, lists of metrics and figures, paths.
#include "harness/scenario/shared_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "harness/files/placed_error.hpp"
#include "harness/files/text_file.hpp"
#include "harness/scenario/modules.hpp"

namespace scanbench::harness {
namespace {

ParamSpec seed_spec(std::string name, Bounds bounds) {
  ParamSpec spec;
  spec.name = std::move(name);
  spec.type = ParamType::integer;
  spec.bounds = bounds;
  return spec;
}

std::uint64_t read_seed(const YamlNode& node, const std::string& name) {
  return static_cast<std::uint64_t>(
      std::get<std::int64_t>(read_param(node, seed_spec(name, between(0, static_cast<double>(kLargestSeed))))));
}

// `name` under `key` in a map {key: name, params: {...}}; extra keys are refused.
ModuleChoice read_module(const YamlNode& node, const std::string& kind, const std::string& key,
                         const std::string& what) {
  YamlMap map(node, what);
  const YamlNode& name_node = map.require(key, fmt::format("one of {}", fmt::join(module_names(kind), ", ")));
  const std::string name = map.text(key, "a name");
  ModuleChoice choice{kind, name, {}};
  const auto entry = at_param(name_node, [&] { return find_module(kind, name); });
  if (const YamlNode* params_node = map.find("params")) {
    YamlMap params(*params_node, "params of " + name);
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

PipelineSpec read_pipeline(const YamlNode& node, bool scans) {
  YamlMap map(node, "a pipeline");
  PipelineSpec pipeline;
  pipeline.name = map.text("name", "a name for tables and figures");
  check_name(pipeline.name, map.find("name")->mark, "the pipeline's name");
  pipeline.published = map.text_or("published", "");
  const YamlNode* nodes[5] = {};
  for (std::size_t i = 0; i < slot_kinds().size(); ++i) {
    const std::string& kind = slot_kinds()[i];
    nodes[i] = map.find(kind);
    if (nodes[i] != nullptr)
      pipeline.slots.push_back(read_module(*nodes[i], kind, "module", fmt::format("{} of {}", kind, pipeline.name)));
  }
  map.done();
  const auto& [extract, align, match, mapper, merge] = nodes;
  if (!scans && extract != nullptr)
    throw PlacedError(extract->mark,
                      fmt::format("pipeline {} has 'extract', but there are no scans, only lines; allowed: align or "
                                  "match, then map or merge",
                                  pipeline.name));
  if (!scans && pipeline.slots.empty())
    throw PlacedError(
        node.mark, fmt::format("pipeline {} has no slot; allowed: align or match, then map or merge", pipeline.name));
  if (scans && extract == nullptr)
    throw PlacedError(
        node.mark, fmt::format("pipeline {} has no 'extract'; allowed: extract, then align or match, then map or merge",
                               pipeline.name));
  if (align != nullptr && match != nullptr)
    throw PlacedError(match->mark,
                      fmt::format("pipeline {} has both align and match; allowed: one of them", pipeline.name));
  if (mapper != nullptr && merge != nullptr)
    throw PlacedError(merge->mark,
                      fmt::format("pipeline {} has both map and merge; allowed: one of them", pipeline.name));
  return pipeline;
}

}  // namespace

std::vector<std::uint64_t> read_seeds(YamlMap& map) {
  const YamlNode* one = map.find("seed");
  const YamlNode* many = map.find("seeds");
  if (one != nullptr && many != nullptr) throw PlacedError(many->mark, "both seed and seeds; allowed: one of them");
  if (one != nullptr) return {read_seed(*one, "seed")};
  if (many == nullptr) return {};
  std::vector<std::uint64_t> seeds;
  if (many->kind == YamlKind::map) {
    YamlMap range(*many, "seeds");
    const std::uint64_t first = read_seed(range.require("first", "a seed"), "first");
    const auto count = std::get<std::int64_t>(
        read_param(range.require("count", "how many seeds"), seed_spec("count", between(1, 100000))));
    range.done();
    if (const std::uint64_t last = first + static_cast<std::uint64_t>(count) - 1; last > kLargestSeed)
      throw PlacedError(many->mark,
                        fmt::format("the last of these seeds is {}; allowed: up to {}", last, kLargestSeed));
    for (std::int64_t i = 0; i < count; ++i) seeds.push_back(first + static_cast<std::uint64_t>(i));
    return seeds;
  }
  for (const auto& node : read_list(*many, "seeds", "a list, [1, 2, 3], or {first: 1, count: 20}")) {
    seeds.push_back(read_seed(node, "a seed"));
    if (std::ranges::count(seeds, seeds.back()) > 1)
      throw PlacedError(node.mark, fmt::format("the seed {} stands here a second time", seeds.back()));
  }
  if (seeds.empty()) throw PlacedError(many->mark, "seeds is empty; allowed: at least one");
  return seeds;
}

std::vector<PipelineSpec> read_pipelines(const YamlNode& node, bool scans) {
  std::vector<PipelineSpec> pipelines;
  for (const auto& item : read_list(node, "pipelines", "a list of {name, extract, ...}")) {
    pipelines.push_back(read_pipeline(item, scans));
    if (std::ranges::count(pipelines, pipelines.back().name, &PipelineSpec::name) > 1)
      throw PlacedError(item.mark,
                        fmt::format("a second pipeline is called {}; allowed: different names", pipelines.back().name));
  }
  return pipelines;
}

std::vector<ModuleChoice> read_choices(const YamlNode& node, const std::string& kind) {
  const std::string list = kind == "figure" ? "figures" : kind;
  std::vector<ModuleChoice> choices;
  for (const auto& item : read_list(node, list, "a list of names or of {name, params}")) {
    if (item.kind == YamlKind::scalar) {
      const auto entry = at_param(item, [&] { return find_module(kind, item.text); });
      choices.push_back({kind, item.text, resolve(entry.params, {})});
    } else {
      choices.push_back(read_module(item, kind, "name", "an element of " + list));
    }
    if (std::ranges::count(choices, choices.back().module, &ModuleChoice::module) > 1)
      throw PlacedError(item.mark, fmt::format("{} stands in {} a second time", choices.back().module, list));
  }
  return choices;
}

void check_name(const std::string& name, Mark mark, const std::string& what) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == '-' ||
      !std::ranges::all_of(name, good))
    throw PlacedError(
        mark, fmt::format("{} is {}; allowed: 1 to 100 letters, digits, _ - and ., not beginning with - or .", what,
                          quoted_excerpt(name)));
}

std::filesystem::path resolve_path(const YamlNode& node, const std::string& text, const std::filesystem::path& file) {
  constexpr std::string_view kVariable = "${SCANBENCH_DATA}";
  std::string expanded = text;
  if (const std::size_t at = expanded.find(kVariable); at != std::string::npos) {
    const char* value = std::getenv("SCANBENCH_DATA");
    if (value == nullptr || *value == '\0')
      throw PlacedError(node.mark,
                        "${SCANBENCH_DATA} is not set; set that environment variable to the folder that holds the "
                        "data sets, or write the path out");
    expanded.replace(at, kVariable.size(), value);
  }
  if (expanded.find("${") != std::string::npos)
    throw PlacedError(node.mark, quoted_excerpt(text) + " names a variable; allowed: ${SCANBENCH_DATA} and no other");
  const std::filesystem::path path(expanded);
  // A path on the command line means what it means to the shell.
  const bool from_command_line = node.mark.line == 0;
  std::filesystem::path result = path.is_absolute() || from_command_line ? path : file.parent_path() / path;
  std::error_code error;
  if (!std::filesystem::exists(result, error)) throw PlacedError(node.mark, "no such file: " + result.string());
  return result;
}

}  // namespace scanbench::harness
