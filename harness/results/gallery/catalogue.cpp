// Reads a catalogue, and reduces its scenarios to what the entries need.
#include "harness/results/gallery/catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/published.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/shared_keys.hpp"
#include "harness/study/scenario/world_file.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSeeds = 1000;

class CatalogueReader {
 public:
  CatalogueReader(const io::YamlNode& root, const std::vector<std::string>& only, Catalogue& catalogue)
      : map_(root, "the catalogue"), only_(only), catalogue_(catalogue) {}

  void read() {
    study::read_schema(map_);
    catalogue_.about = map_.text_or("about", "");
    const io::YamlNode& figures = map_.require("figures", "a list of figures");
    const io::YamlNode* absent = map_.find("absent");
    map_.done();
    for (const io::YamlNode& node : io::read_list(figures, "figures", "a list of figures")) read_entry(node);
    if (absent != nullptr)
      for (const io::YamlNode& node : io::read_list(*absent, "absent", "a list of {of, why}")) {
        io::YamlMap entry(node, "a figure that cannot be made");
        catalogue_.absent.push_back({entry.text("of", "the paper and its number"), entry.text("why", "a reason")});
        entry.done();
      }
    for (const std::string& name : only_)
      if (std::ranges::count(names_, name) == 0)
        throw ConfigError("--entry: the catalogue has no figure " + io::quoted_excerpt(name) +
                          known_names(name, names_));
    if (catalogue_.entries.empty())
      throw io::PlacedError(figures.mark, "figures is empty; allowed: at least one figure");
    reduce();
  }

 private:
  void read_entry(const io::YamlNode& node) {
    io::YamlMap map(node, "the figure");
    CatalogueEntry entry;
    entry.name = map.text("name", "a name for its files");
    study::require_folder_name(entry.name, node.mark, "the figure");
    if (std::ranges::count(names_, entry.name) > 0)
      throw io::PlacedError(node.mark, "a second figure is called " + entry.name + "; allowed: different names");
    names_.push_back(entry.name);
    marks_[entry.name] = node.mark;
    entry.of = map.text("of", "the paper and its number");
    entry.shows = map.text("shows", "what the figure shows");
    const study::Scenario& scenario = scenario_of(map, entry);
    const io::YamlNode* figure = map.find("figure");
    const io::YamlNode* table = map.find("table");
    if ((figure == nullptr) == (table == nullptr))
      throw io::PlacedError(node.mark, entry.name + " needs either `figure` or `table`");
    if (const io::YamlNode* pipelines = map.find("pipelines")) read_pipeline_names(*pipelines, scenario, entry);
    if (figure != nullptr) read_figure(*figure, scenario, entry);
    if (table != nullptr) read_table(*table, scenario, entry);
    if (const io::YamlNode* seeds = map.find("seeds")) entry.seeds = seeds_of(*seeds, scenario);
    if (const io::YamlNode* seed = map.find("seed")) choose_seed(*seed, scenario);
    map.done();
    if (only_.empty() || std::ranges::count(only_, entry.name) > 0) catalogue_.entries.push_back(std::move(entry));
  }

  /// The scenario, which is read once.
  const study::Scenario& scenario_of(io::YamlMap& map, CatalogueEntry& entry) {
    const io::YamlNode& node = map.require("scenario", "a scenario file");
    entry.scenario_as_written = io::read_word(node, "scenario", "a scenario file");
    const auto known = scenarios_.find(entry.scenario_as_written);
    if (known != scenarios_.end()) {
      entry.scenario = known->second.name;
      return known->second;
    }
    const fs::path path = resolve_scenario(node, entry.scenario_as_written);
    study::Scenario scenario = study::load_scenario(path);
    for (const auto& [file, other] : scenarios_)
      if (other.name == scenario.name)
        throw io::PlacedError(node.mark,
                              "a second file has a scenario called " + scenario.name + ", as " + file + " has");
    entry.scenario = scenario.name;
    order_.push_back(entry.scenario_as_written);
    return scenarios_.emplace(entry.scenario_as_written, std::move(scenario)).first->second;
  }

  fs::path resolve_scenario(const io::YamlNode& node, const std::string& text) const {
    const fs::path path = catalogue_.path.parent_path() / text;
    std::error_code error;
    if (text.find("${") == std::string::npos && !fs::exists(path, error)) {
      const std::string near = nearest_name(path.filename().string(), io::names_in(path.parent_path()));
      const std::string hint =
          near.empty() ? "" : "; did you mean '" + (fs::path(text).parent_path() / near).generic_string() + "'?";
      throw io::PlacedError(node.mark,
                            "there is no scenario " + io::quoted_excerpt(text) + " (" + path.string() + ")" + hint);
    }
    return study::resolve_path(node, text, catalogue_.path);
  }

  static void read_pipeline_names(const io::YamlNode& list, const study::Scenario& scenario, CatalogueEntry& entry) {
    std::vector<std::string> known;
    for (const study::PipelineSpec& pipeline : scenario.pipelines) known.push_back(pipeline.name);
    for (const io::YamlNode& node : io::read_list(list, "pipelines", "a list of names")) {
      const std::string& name = io::read_word(node, "a pipeline", "a name");
      if (std::ranges::count(known, name) == 0)
        throw io::PlacedError(node.mark, fmt::format("{} has no pipeline {}{}", scenario.name, io::quoted_excerpt(name),
                                                     known_names(name, known)));
      entry.pipelines.push_back(name);
    }
  }

  static void read_figure(const io::YamlNode& node, const study::Scenario& scenario, CatalogueEntry& entry) {
    io::YamlNode list;
    list.kind = io::YamlKind::sequence;
    list.mark = node.mark;
    list.items.push_back(node);
    entry.figure = study::read_choices(list, "figure");
    std::vector<study::PipelineSpec> pipelines = scenario.pipelines;
    if (!entry.pipelines.empty())
      std::erase_if(pipelines, [&](const auto& p) { return std::ranges::count(entry.pipelines, p.name) == 0; });
    study::check_figure_pipelines(list, entry.figure, pipelines);
  }

  static void read_table(const io::YamlNode& node, const study::Scenario& scenario, CatalogueEntry& entry) {
    entry.table = io::read_word(node, "table", "the paper's number of the table, or text");
    std::vector<std::string> known;
    if (!scenario.published_file.empty())
      for (const study::PublishedValue& value : study::load_published(scenario.published_file)) {
        const std::string table = value.table.empty() ? "text" : value.table;
        if (std::ranges::count(known, table) == 0) known.push_back(table);
      }
    if (std::ranges::count(known, entry.table) == 0)
      throw io::PlacedError(node.mark, fmt::format("{} has no published table {}{}", scenario.name,
                                                   io::quoted_excerpt(entry.table), known_names(entry.table, known)));
  }

  static std::size_t seeds_of(const io::YamlNode& node, const study::Scenario& scenario) {
    const double value = io::read_number(node, "seeds");
    const std::size_t most = std::min(kMostSeeds, scenario.seeds.size());
    if (!(value >= 1) || value > static_cast<double>(most) || value != static_cast<double>(static_cast<long>(value)))
      throw io::PlacedError(node.mark, fmt::format("seeds is {}; allowed: a whole number 1 .. {}, the seeds of {}",
                                                   node.text, most, scenario.name));
    return static_cast<std::size_t>(value);
  }

  /// Puts a seed before the others, because figures show the first one.
  void choose_seed(const io::YamlNode& node, const study::Scenario& scenario) {
    const double value = io::read_number(node, "seed");
    const auto known =
        std::ranges::find_if(scenario.seeds, [&](std::uint64_t s) { return static_cast<double>(s) == value; });
    if (known == scenario.seeds.end())
      throw io::PlacedError(node.mark, fmt::format("{} has no seed {}; known: {}", scenario.name,
                                                   io::quoted_excerpt(node.text), fmt::join(scenario.seeds, ", ")));
    const auto [chosen, is_new] = first_seeds_.try_emplace(scenario.name, *known);
    if (!is_new && chosen->second != *known)
      throw io::PlacedError(node.mark,
                            fmt::format("seed is {}, but an earlier figure of {} has seed {}; allowed: the same "
                                        "for all figures of a scenario",
                                        node.text, scenario.name, chosen->second));
  }

  /// Leaves in each scenario what its entries need.
  void reduce() {
    for (const std::string& file : order_) {
      study::Scenario scenario = scenarios_.at(file);
      std::vector<std::string> pipelines;
      std::size_t seeds = 0;
      bool all = false;
      scenario.figures.clear();
      for (const CatalogueEntry& entry : catalogue_.entries) {
        if (entry.scenario != scenario.name) continue;
        seeds = std::max(seeds, entry.seeds);
        all = all || entry.pipelines.empty();
        pipelines.insert(pipelines.end(), entry.pipelines.begin(), entry.pipelines.end());
        if (!entry.figure.empty()) add_figure(entry, scenario);
      }
      if (seeds == 0) continue;
      if (const auto first = first_seeds_.find(scenario.name); first != first_seeds_.end()) {
        std::erase(scenario.seeds, first->second);
        scenario.seeds.insert(scenario.seeds.begin(), first->second);
      }
      scenario.seeds.resize(std::min(seeds, scenario.seeds.size()));
      if (!all)
        std::erase_if(scenario.pipelines, [&](const auto& p) { return std::ranges::count(pipelines, p.name) == 0; });
      catalogue_.scenarios.push_back(std::move(scenario));
    }
  }

  /// A scenario has each kind of figure once; they decide which traces its run keeps.
  void add_figure(const CatalogueEntry& entry, study::Scenario& scenario) const {
    const study::ModuleChoice& figure = entry.figure.front();
    const auto same = std::ranges::find(scenario.figures, figure.module, &study::ModuleChoice::module);
    if (same == scenario.figures.end()) {
      scenario.figures.push_back(figure);
      return;
    }
    study::Scenario kept = scenario, wanted = scenario;
    kept.figures = {*same};
    wanted.figures = {figure};
    for (const study::PipelineSpec& pipeline : scenario.pipelines)
      for (const std::string& row : study::traces_drawn(wanted, pipeline.name).names)
        if (!study::traces_drawn(kept, pipeline.name).names.contains(row))
          throw io::PlacedError(marks_.at(entry.name),
                                fmt::format("{} draws {} of the trace of {}, which an earlier {} of {} does not keep; "
                                            "allowed: figures of one kind with the same pipeline",
                                            entry.name, row, pipeline.name, figure.module, scenario.name));
  }

  io::YamlMap map_;
  const std::vector<std::string>& only_;
  Catalogue& catalogue_;
  std::map<std::string, std::uint64_t> first_seeds_;  ///< by scenario
  std::map<std::string, io::Mark> marks_;             ///< of the entries
  std::vector<std::string> names_;                    ///< of all entries
  std::map<std::string, study::Scenario> scenarios_;  ///< by the path in the file
  std::vector<std::string> order_;                    ///< their paths, as they come
};

}  // namespace

Catalogue parse_catalogue(std::string_view text, const fs::path& path, const std::vector<std::string>& only) {
  return io::in_file(path.string(), {}, [&] {
    Catalogue catalogue{.path = path, .about = {}, .entries = {}, .absent = {}, .scenarios = {}};
    CatalogueReader(io::parse_yaml(text), only, catalogue).read();
    return catalogue;
  });
}

bool is_catalogue(const fs::path& path) {
  const std::string text = io::read_text_file(path, io::kMaxWorldBytes);  // a scenario may have its world in it
  return io::in_file(path.string(), {}, [&] {
    const io::YamlNode root = io::parse_yaml(text, io::kMaxWorldBytes);
    const auto has = [&](const char* key) { return root.find(key) != nullptr; };
    return has("figures") && !has("pipelines") && !has("scenarios") && !has("metrics");
  });
}

Catalogue load_catalogue(const fs::path& path, const std::vector<std::string>& only) {
  return parse_catalogue(io::read_text_file(path, io::kMaxYamlBytes), path, only);
}

}  // namespace scanbench::results
