// check, list, describe: nothing runs, nothing is written.
#include <fmt/format.h>

#include <charconv>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "harness/report/catalog.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/scenario_file.hpp"
#include "harness/scenario/suite.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

void print(const std::string& text) {
  fmt::print("{}", text);
}

int check(const std::vector<std::string>& files, const std::vector<std::string>& sets, bool effective) {
  for (const auto& scenario : load_inputs(files, sets)) {
    harness::check_scenario(scenario);
    if (effective) {
      print(harness::effective_yaml(scenario));
      continue;
    }
    fmt::print("{}: good: {} pipeline{} on {} seed{}\n", scenario.path.string(), scenario.pipelines.size(),
               scenario.pipelines.size() == 1 ? "" : "s", scenario.seeds.size(), scenario.seeds.size() == 1 ? "" : "s");
    for (const auto& note : scenario.notes) fmt::print("  note: {}\n", note);
  }
  return kGood;
}

int list(const std::string& kind, bool json) {
  std::vector<harness::CatalogEntry> entries;
  std::vector<std::string> kinds;
  for (auto& entry : harness::catalog()) {
    if (kinds.empty() || kinds.back() != entry.kind) kinds.push_back(entry.kind);
    if (kind.empty() || entry.kind == kind) entries.push_back(std::move(entry));
  }
  if (entries.empty()) {
    std::string known;
    for (const auto& k : kinds) known += (known.empty() ? "" : ", ") + k;
    throw ConfigError("there is no kind '" + kind + "'; kinds: " + known);
  }
  print(json ? harness::catalog_json(entries) : harness::catalog_text(entries));
  return kGood;
}

int describe(const std::string& name, bool all, bool markdown, bool json) {
  if (name.empty() && !all) throw ConfigError("describe needs a name, or --all (`scanbench list` shows the names)");
  const auto entries = all ? harness::catalog() : harness::find_in_catalog(name);
  if (json) {
    print(harness::catalog_json(entries));
  } else if (markdown) {
    print(harness::catalog_markdown(entries));
  } else {
    for (const auto& entry : entries) print(harness::describe_text(entry) + (&entry == &entries.back() ? "" : "\n"));
  }
  return kGood;
}

}  // namespace

std::vector<harness::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                           std::string* name, std::optional<harness::BenchmarkSpec>* benchmark) {
  std::vector<harness::Scenario> scenarios;
  for (const auto& file : files) {
    if (name != nullptr && name->empty()) *name = fs::path(file).stem().string();
    if (harness::is_suite(file)) {
      harness::Suite suite = harness::load_suite(file, sets);
      for (auto& scenario : suite.scenarios) scenarios.push_back(std::move(scenario));
      if (benchmark != nullptr && files.size() == 1) *benchmark = suite.benchmark;
    } else {
      scenarios.push_back(harness::load_scenario(file, sets));
      if (name != nullptr && files.size() == 1) *name = scenarios.back().name;
    }
  }
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (scenarios[i].name == scenarios[j].name)
        throw ConfigError("two scenarios are called '" + scenarios[i].name + "': " + scenarios[j].path.string() +
                          " and " + scenarios[i].path.string() + "; their results would fall into one folder");
  return scenarios;
}

void give_seeds(std::vector<harness::Scenario>& scenarios, const std::vector<std::string>& texts) {
  std::vector<std::uint64_t> seeds;
  for (const auto& text : texts) {
    std::uint64_t seed = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    if (text.empty() || error != std::errc() || stop != end || seed > harness::kLargestSeed)
      throw ConfigError("--seed: '" + text + "' is no seed; allowed: whole numbers 0 .. " +
                        std::to_string(harness::kLargestSeed) + ", separated by commas");
    if (std::ranges::count(seeds, seed) > 0) throw ConfigError("--seed: " + text + " is given twice");
    seeds.push_back(seed);
  }
  if (seeds.empty()) return;
  for (auto& scenario : scenarios) scenario.seeds = seeds;
}

void add_inspection(Context& context) {
  struct Options {
    std::vector<std::string> files, sets;
    std::string name;
    bool effective = false, json = false, all = false, markdown = false;
  };
  auto options = std::make_shared<Options>();

  auto* check_verb =
      context.app.add_subcommand("check", "Reads scenario or suite files and says whether they are all right");
  check_verb->add_option("FILE", options->files, "scenario or suite files")->required();
  check_verb->add_option("--set", options->sets, "KEY=VALUE: a value in place of the file's (dotted keys)")->take_all();
  check_verb->add_flag("--effective", options->effective, "print the scenario with every default filled in");
  check_verb->callback([&context, options] {
    context.action = [options] { return check(options->files, options->sets, options->effective); };
  });

  auto* list_verb = context.app.add_subcommand("list", "Lists modules, metrics, figures, trajectories and sensors");
  list_verb->add_option("KIND", options->name,
                        "only this kind: extract, merge, metrics, figure, trajectory, sensor, ...");
  list_verb->add_flag("--json", options->json, "as JSON");
  list_verb->callback(
      [&context, options] { context.action = [options] { return list(options->name, options->json); }; });

  auto* describe_verb =
      context.app.add_subcommand("describe", "Shows what a module does, its parameters, defaults and bounds");
  describe_verb->add_option("NAME", options->name, "a name from `list`");
  describe_verb->add_flag("--all", options->all, "everything");
  describe_verb->add_flag("--markdown", options->markdown,
                          "as Markdown (docs/modules.md is made with --all --markdown)");
  describe_verb->add_flag("--json", options->json, "as JSON");
  describe_verb->callback([&context, options] {
    context.action = [options] { return describe(options->name, options->all, options->markdown, options->json); };
  });
}

}  // namespace scanbench::app
