// Reads a suite: loads its scenarios and replaces their parts by those of the suite.
#include "harness/study/scenario/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/io/yaml/sets.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/scenario/factors.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/published.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/shared_keys.hpp"
#include "harness/study/scenario/world_file.hpp"

namespace scanbench::study {
namespace {

class SuiteReader {
 public:
  SuiteReader(const io::YamlNode& root, const std::vector<std::string>& sets, Suite& suite)
      : map_(root, "the suite"), sets_(sets), suite_(suite) {}

  void read() {
    read_schema(map_);
    suite_.about = map_.text_or("about", "");
    seeds_ = read_seeds(map_);
    read_libraries();
    pipelines_ = map_.find("pipelines");
    if (const io::YamlNode* node = map_.find("metrics")) metrics_ = read_choices(*node, "metrics");
    figures_node_ = map_.find("figures");
    if (figures_node_ != nullptr) figures_ = read_choices(*figures_node_, "figure");
    if (const io::YamlNode* node = map_.find("published")) {
      published_as_written_ = map_.text("published", "a file's path");
      published_ = resolve_path(*node, published_as_written_, suite_.path);
    }
    const io::YamlNode* factors = map_.find("factors");
    const io::YamlNode* benchmark = map_.find("benchmark");
    if (const io::YamlNode* node = map_.find("gates")) suite_.rules.gates = read_gates(*node);
    const io::YamlNode& files = map_.require("scenarios", "a list of scenario files");
    map_.done();
    const std::vector<Variant> variants = factors != nullptr ? read_variants(*factors) : std::vector<Variant>{};
    for (const auto& node : io::read_list(files, "scenarios", "a list of scenario files")) {
      const auto path = resolve_path(node, io::read_word(node, "a scenario", "a file's path"), suite_.path);
      Scenario plain = load(path, sets_);
      if (variants.empty()) {
        add(std::move(plain), node.mark);
        continue;
      }
      refuse_sets_over_factors(*factors, sets_, list_names(plain));
      for (const Variant& variant : variants) {
        add(load_variant(path, plain.name, variant), node.mark);
        add_levels(plain.name, variant);
      }
    }
    if (suite_.scenarios.empty())
      throw io::PlacedError(files.mark, "scenarios is empty; allowed: at least one scenario file");
    if (benchmark == nullptr) return;
    suite_.rules.benchmark = read_benchmark(*benchmark, suite_.scenarios);
    suite_.rules.benchmark->about = suite_.about;
    suite_.rules.benchmark->levels = levels_;
  }

 private:
  static ListNames list_names(const Scenario& scenario) {
    ListNames names;
    for (const auto& pipeline : scenario.pipelines) names["pipelines"].push_back(pipeline.name);
    for (const auto& metric : scenario.metrics) names["metrics"].push_back(metric.module);
    for (const auto& figure : scenario.figures) names["figures"].push_back(figure.module);
    return names;
  }

  /// The libraries of the suite, and those of overrides.
  void read_libraries() {
    const io::YamlNode* node = map_.find("plugins");
    const auto sets = sets_of_section(sets_, "plugins");
    sources_.libraries = io::in_file(suite_.path.string(), sets, [&] {
      io::YamlNode root = io::yaml_map();
      if (node != nullptr) io::yaml_add(root, "plugins", *node);
      io::apply_sets(root, sets);
      io::YamlMap map(root, "the suite");
      return read_plugins(map, sources_);
    });
  }

  /// Loads a scenario and replaces its parts by those of the suite.
  Scenario load(const std::filesystem::path& path, const std::vector<std::string>& sets) const {
    Scenario scenario = load_scenario(path, pipelines_ != nullptr ? sets_outside_section(sets, "pipelines") : sets);
    if (!seeds_.empty() && has_chance(scenario)) scenario.seeds = seeds_;
    const bool scans = !std::holds_alternative<LinesInput>(scenario.input);
    if (pipelines_ != nullptr) scenario.pipelines = pipelines_with(sets_of_section(sets, "pipelines"), scans);
    if (metrics_) scenario.metrics = *metrics_;
    if (figures_node_ != nullptr) {
      scenario.figures = figures_;
      check_figure_pipelines(*figures_node_, figures_, scenario.pipelines);
    } else if (pipelines_ != nullptr) {
      check_figure_pipelines(pipelines_->mark, scenario);
    }
    if (!published_.empty()) {
      scenario.published_file = published_;
      scenario.published_as_written = published_as_written_;
    }
    check_published(scenario);
    return scenario;
  }

  /// Errors have the place of the level, because the scenario is valid without it.
  Scenario load_variant(const std::filesystem::path& path, const std::string& name, const Variant& variant) const {
    std::vector<std::string> sets = variant.sets;
    sets.insert(sets.end(), sets_.begin(), sets_.end());
    try {
      Scenario scenario = load(path, sets);
      scenario.name = name + variant.suffix;
      return scenario;
    } catch (const ConfigError& error) {
      throw io::PlacedError(variant.mark, fmt::format("{}{}: {}", name, variant.suffix, error.what()));
    }
  }

  std::vector<PipelineSpec> pipelines_with(const std::vector<std::string>& sets, bool scans) const {
    return io::in_file(suite_.path.string(), sets, [&] {
      io::YamlNode root = io::yaml_map();
      root.mark = pipelines_->mark;
      io::YamlNode& pipelines = io::yaml_add(root, "pipelines", *pipelines_);
      io::apply_sets(root, sets);
      return read_pipelines(pipelines, scans, sources_);
    });
  }

  void add(Scenario scenario, io::Mark mark) {
    if (std::ranges::find(suite_.scenarios, scenario.name, &Scenario::name) != suite_.scenarios.end())
      throw io::PlacedError(mark,
                            fmt::format("a second scenario is called {}; allowed: different names", scenario.name));
    suite_.scenarios.push_back(std::move(scenario));
  }

  /// Enters the scenario that was added last at its level of every factor.
  void add_levels(const std::string& file, const Variant& variant) {
    auto levels = variant.levels;
    levels.insert(levels.begin(), {"scenario", file});
    for (const auto& [factor, level] : levels) {
      const auto key = [](const BenchmarkLevel& l) { return std::tie(l.factor, l.level); };
      auto found = std::ranges::find(levels_, std::tie(factor, level), key);
      if (found == levels_.end()) found = levels_.insert(end_of(factor), {factor, level, {}});
      found->scenarios.push_back(suite_.scenarios.back().name);
    }
  }

  /// Behind the last level of a factor, so that the levels of one factor are neighbours.
  std::vector<BenchmarkLevel>::iterator end_of(const std::string& factor) {
    const auto last = std::ranges::find(levels_.rbegin(), levels_.rend(), factor, &BenchmarkLevel::factor);
    return last == levels_.rend() ? levels_.end() : last.base();
  }

  io::YamlMap map_;
  const std::vector<std::string>& sets_;
  Suite& suite_;
  ModuleSources sources_{.file = suite_.path, .sandbox = std::ranges::count(sets_, "limits.sandbox=true") > 0};
  std::vector<BenchmarkLevel> levels_;
  std::vector<std::uint64_t> seeds_;
  const io::YamlNode* pipelines_ = nullptr;
  std::optional<std::vector<ModuleChoice>> metrics_;
  const io::YamlNode* figures_node_ = nullptr;
  std::vector<ModuleChoice> figures_;
  std::filesystem::path published_;
  std::string published_as_written_;
};

}  // namespace

bool is_suite(const std::filesystem::path& path) {
  const std::string text = io::read_text_file(path, io::kMaxWorldBytes);
  return io::in_file(path.string(), {},
                     [&] { return io::parse_yaml(text, io::kMaxWorldBytes).find("scenarios") != nullptr; });
}

Suite parse_suite(std::string_view text, const std::filesystem::path& path, const std::vector<std::string>& sets) {
  Suite suite;
  suite.name = path.stem().string();
  suite.path = path;
  suite.text = text;
  io::in_file(path.string(), {}, [&] {
    const io::YamlNode root = io::parse_yaml(text);
    SuiteReader(root, sets, suite).read();
  });
  return suite;
}

Suite load_suite(const std::filesystem::path& path, const std::vector<std::string>& sets) {
  return parse_suite(io::read_text_file(path, io::kMaxYamlBytes), path, sets);
}

}  // namespace scanbench::study
