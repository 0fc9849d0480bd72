// The verbs check, list and describe, which run and write nothing.
#include "app/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/foreign.hpp"
#include "app/inputs.hpp"
#include "harness/gallery/catalogue.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/report/catalog.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/run/run_plan.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/scenario/suite.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

/// Text of foreign modules must not control the terminal.
void print(const std::string& text) {
  fmt::print("{}", harness::plain_text(text));
}

std::string counted(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// The scenarios of one file, which have been checked. Those of a suite are named: its conditions.
void print_good(const std::string& file, const std::vector<harness::Scenario>& scenarios) {
  std::size_t cells = 0;
  for (const auto& scenario : scenarios) cells += scenario.pipelines.size() * scenario.seeds.size();
  const bool suite = harness::is_suite(file);
  if (suite) fmt::print("{}: good: {}, {}\n", file, counted(scenarios.size(), "scenario"), counted(cells, "cell"));
  for (const auto& scenario : scenarios) {
    fmt::print("{}: {}{} on {}\n", suite ? "  " + scenario.name : file,
               suite ? "" : "good: ", counted(scenario.pipelines.size(), "pipeline"),
               counted(scenario.seeds.size(), "seed"));
    for (const auto& note : scenario.notes) fmt::print("{}  note: {}\n", suite ? "  " : "", note);
  }
}

/// Checks the catalogues of figures and removes them from the list of files.
void check_catalogues(std::vector<std::string>& files) {
  std::erase_if(files, [](const std::string& file) {
    if (!fs::is_regular_file(file) || !harness::is_catalogue(file)) return false;
    const harness::Catalogue catalogue = harness::load_catalogue(file);
    fmt::print("{}: good: {} figures and tables of {}\n", file, catalogue.entries.size(),
               counted(catalogue.scenarios.size(), "scenario"));
    return true;
  });
}

int check(std::vector<std::string> files, const std::vector<std::string>& sets, bool effective, bool for_simulate) {
  check_catalogues(files);
  if (files.empty()) return kGood;
  const auto all = load_inputs(files, sets);
  // What run refuses, check refuses too, in the same words.
  if (!for_simulate && !effective) harness::plan_run(all, {.out = {}});
  for (const auto& scenario : all) {
    harness::check_scenario(scenario);
    if (effective) print(harness::effective_yaml(scenario));
  }
  if (effective) return kGood;
  for (const auto& file : files) print_good(file, files.size() == 1 ? all : load_inputs({file}, sets));
  return kGood;
}

int list(const std::string& kind, bool json) {
  const auto entries = harness::catalog_of_kind(kind);
  print(json ? harness::catalog_json(entries) : harness::catalog_text(entries));
  return kGood;
}

int describe(const std::string& name, const ForeignOptions& foreign, bool all, bool markdown, bool json) {
  const bool is_foreign = !foreign.plugins.empty() || !foreign.program.empty();
  if (name.empty() && !all && !is_foreign)
    throw ConfigError("describe needs a name, or --all (`scanbench list` shows the names)");
  const auto entries = is_foreign ? foreign_entries(foreign)
                       : all      ? harness::catalog()
                                  : harness::find_in_catalog(name);
  if (json) {
    print(harness::catalog_json(entries));
  } else if (markdown) {
    print(harness::catalog_markdown(entries));
  } else {
    for (const auto& entry : entries) print(harness::describe_text(entry) + (&entry == &entries.back() ? "" : "\n"));
  }
  return kGood;
}

/// For completion on the command line.
std::vector<std::string> kinds() {
  std::vector<std::string> words{"modules"};
  for (const auto& entry : harness::catalog())
    if (words.back() != entry.kind) words.push_back(entry.kind);
  return words;
}

std::vector<std::string> names() {
  std::vector<std::string> words;
  for (const auto& entry : harness::catalog()) words.push_back(entry.info.name);
  return words;
}

}  // namespace

void add_inspection(Context& context) {
  struct Options {
    std::vector<std::string> files, sets;
    std::string name;
    ForeignOptions foreign;
    bool effective = false, for_simulate = false, json = false, all = false, markdown = false;
  };
  auto options = std::make_shared<Options>();

  auto* check_verb = context.app.add_subcommand(
      "check", "Checks scenario or suite files, or catalogues of figures, without running them");
  check_verb->add_option("FILE", options->files, "scenario or suite files, catalogues of figures")->required();
  check_verb->add_option("--set", options->sets, "KEY=VALUE: replaces a value of the file (dotted keys)")->take_all();
  add_foreign_options(*check_verb, options->foreign, false);
  check_verb->add_flag("--effective", options->effective, "print the scenario with every default filled in");
  check_verb->add_flag("--simulate", options->for_simulate, "check for `simulate`, which needs no pipelines");
  check_verb->callback([&context, options] {
    context.action = [options] {
      return check(options->files, with_foreign(options->sets, options->foreign, false), options->effective,
                   options->for_simulate);
    };
  });

  auto* list_verb = context.app.add_subcommand("list", "Lists modules, metrics, figures, trajectories and sensors");
  context.words[list_verb->add_option(
      "KIND", options->name, "only this kind: modules, extract, merge, metrics, figures, trajectories, sensors, ...")] =
      kinds;
  list_verb->add_flag("--json", options->json, "as JSON");
  list_verb->callback(
      [&context, options] { context.action = [options] { return list(options->name, options->json); }; });

  auto* describe_verb =
      context.app.add_subcommand("describe", "Shows what a module does, its parameters, defaults and bounds");
  context.words[describe_verb->add_option("NAME", options->name, "a name from `list`, or a metric, like f1")] = names;
  describe_verb->add_flag("--all", options->all, "describe everything");
  describe_verb->add_flag("--markdown", options->markdown,
                          "as Markdown (docs/modules.md is made with --all --markdown)");
  add_foreign_options(*describe_verb, options->foreign, true);
  describe_verb->add_flag("--json", options->json, "as JSON");
  describe_verb->callback([&context, options] {
    context.action = [options] {
      return describe(options->name, options->foreign, options->all, options->markdown, options->json);
    };
  });
}

}  // namespace scanbench::app
