// Reading a suite: its scenarios, and what replaces parts of them.
#include "harness/suite.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/scenario_reader.hpp"
#include "harness/text_file.hpp"
#include "harness/world_file.hpp"

namespace scanbench::harness {
namespace {

void read_suite(const YamlNode& root, const std::vector<std::string>& sets, Suite& suite) {
  YamlMap map(root, "the suite");
  read_schema(map);
  suite.about = map.text_or("about", "");
  const std::vector<std::uint64_t> seeds = read_seeds(map);
  const YamlNode* pipelines = map.find("pipelines");
  const YamlNode* metrics = map.find("metrics");
  const YamlNode* figures = map.find("figures");
  const YamlNode* published = map.find("published");
  const auto published_file = published == nullptr
                                  ? std::filesystem::path()
                                  : resolve_path(*published, map.text("published", "a file's path"), suite.path);
  const YamlNode& files = map.require("scenarios", "a list of scenario files");
  map.done();
  for (const auto& node : read_list(files, "scenarios", "a list of scenario files")) {
    Scenario scenario =
        load_scenario(resolve_path(node, read_word(node, "a scenario", "a file's path"), suite.path), sets);
    if (std::ranges::find(suite.scenarios, scenario.name, &Scenario::name) != suite.scenarios.end())
      throw PlacedError(node.mark,
                        fmt::format("a second scenario is called {}; allowed: different names", scenario.name));
    if (!seeds.empty() && has_chance(scenario)) scenario.seeds = seeds;
    const bool scans = !std::holds_alternative<LinesInput>(scenario.input);
    if (pipelines != nullptr) scenario.pipelines = read_pipelines(*pipelines, scans);
    if (metrics != nullptr) scenario.metrics = read_choices(*metrics, "metrics");
    if (figures != nullptr) scenario.figures = read_choices(*figures, "figure");
    if (published != nullptr) scenario.published_file = published_file;
    suite.scenarios.push_back(std::move(scenario));
  }
  if (suite.scenarios.empty()) throw PlacedError(files.mark, "scenarios is empty; allowed: at least one scenario file");
}

}  // namespace

bool is_suite(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, kMaxWorldBytes);
  return in_file(path.string(), {}, [&] { return parse_yaml(text, kMaxWorldBytes).find("scenarios") != nullptr; });
}

Suite parse_suite(std::string_view text, const std::filesystem::path& path, const std::vector<std::string>& sets) {
  Suite suite;
  suite.name = path.stem().string();
  suite.path = path;
  suite.text = text;
  in_file(path.string(), {}, [&] { read_suite(parse_yaml(text), sets, suite); });
  return suite;
}

Suite load_suite(const std::filesystem::path& path, const std::vector<std::string>& sets) {
  return parse_suite(read_text_file(path, kMaxYamlBytes), path, sets);
}

}  // namespace scanbench::harness
