// The verbs check, list and describe, which run and write nothing.
#include "app/verbs/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/foreign.hpp"
#include "app/inputs.hpp"
#include "app/terminal/progress.hpp"
#include "app/text_format.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/figures/catalog.hpp"
#include "harness/results/gallery/catalogue.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/suite.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

/// Text of foreign modules must not control the terminal.
void print(const std::string& text) {
  fmt::print("{}", results::plain_text(text));
}

/// The scenarios of one file, which have been checked. Those of a suite are named: its conditions.
void print_good(const std::string& file, const std::vector<study::Scenario>& scenarios) {
  std::size_t cells = 0;
  for (const auto& scenario : scenarios) cells += scenario.pipelines.size() * scenario.seeds.size();
  const bool suite = study::is_suite(file);
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
    if (!fs::is_regular_file(file) || !results::is_catalogue(file)) return false;
    const results::Catalogue catalogue = results::load_catalogue(file);
    fmt::print("{}: good: {} figures and tables of {}\n", file, catalogue.entries.size(),
               counted(catalogue.scenarios.size(), "scenario"));
    return true;
  });
}

struct CheckOptions {
  std::vector<std::string> files, sets;
  ForeignOptions foreign;
  bool effective = false, for_simulate = false;
};

int check(const CheckOptions& options) {
  std::vector<std::string> files = options.files;
  check_catalogues(files);
  if (files.empty()) return kGood;
  const std::vector<std::string> sets = with_foreign(options.sets, options.foreign, false);
  const auto all = load_inputs(files, sets);
  // What run refuses, check refuses too, in the same words.
  if (!options.for_simulate && !options.effective) runs::plan_run(all, {.out = {}});
  for (const auto& scenario : all) {
    runs::check_scenario(scenario);
    if (options.effective) print(study::effective_yaml(scenario));
  }
  if (options.effective) return kGood;
  for (const auto& file : files) print_good(file, files.size() == 1 ? all : load_inputs({file}, sets));
  return kGood;
}

struct ListOptions {
  std::string kind;
  bool json = false;
};

int list(const ListOptions& options) {
  const auto entries = results::catalog_of_kind(options.kind);
  print(options.json ? results::catalog_json(entries) : results::catalog_text(entries));
  return kGood;
}

struct DescribeOptions {
  std::string name;
  ForeignOptions foreign;
  TextFormat format;
  bool all = false;
};

int describe(const DescribeOptions& options) {
  const std::string format = format_of(options.format);
  const bool is_foreign = !options.foreign.plugins.empty() || !options.foreign.program.empty();
  if (options.name.empty() && !options.all && !is_foreign)
    throw ConfigError("describe needs a name, or --all (`scanbench list` shows the names)");
  const auto entries = is_foreign    ? foreign_entries(options.foreign)
                       : options.all ? results::catalog()
                                     : results::find_in_catalog(options.name);
  if (format == "json") {
    print(results::catalog_json(entries));
  } else if (format == "markdown") {
    print(results::catalog_markdown(entries));
  } else {
    for (const auto& entry : entries) print(results::describe_text(entry) + (&entry == &entries.back() ? "" : "\n"));
  }
  return kGood;
}

/// For completion on the command line.
std::vector<std::string> kind_words() {
  std::vector<std::string> words{"modules"};
  for (const auto& entry : results::catalog())
    if (words.back() != entry.kind) words.push_back(entry.kind);
  return words;
}

std::vector<std::string> name_words() {
  std::vector<std::string> words;
  for (const auto& entry : results::catalog()) words.push_back(entry.info.name);
  return words;
}

}  // namespace

void add_check(CommandLine& line) {
  auto options = std::make_shared<CheckOptions>();
  Verb verb = line.add_verb("check", "Checks scenario or suite files, or catalogues of figures, without running them");
  verb.option("FILE", options->files, "scenario or suite files, catalogues of figures").required();
  add_set_option(verb, options->sets);
  add_foreign_options(verb, options->foreign, false);
  verb.flag("--effective", options->effective, "print the scenario with every default filled in");
  verb.flag("--simulate", options->for_simulate, "check for `simulate`, which needs no pipelines");
  verb.runs([options] { return check(*options); });
}

void add_list(CommandLine& line) {
  auto options = std::make_shared<ListOptions>();
  Verb verb = line.add_verb("list", "Lists modules, metrics, figures, trajectories and sensors");
  verb.option("KIND", options->kind,
              "only this kind: modules, extract, merge, metrics, figures, trajectories, sensors, ...")
      .completed_by(kind_words);
  add_json_flag(verb, options->json, "the list");
  verb.runs([options] { return list(*options); });
}

void add_describe(CommandLine& line) {
  auto options = std::make_shared<DescribeOptions>();
  Verb verb = line.add_verb("describe", "Shows what a module does, its parameters, defaults and bounds");
  verb.option("NAME", options->name, "a name from `list`, or a metric, like f1").completed_by(name_words);
  verb.flag("--all", options->all, "describe everything");
  add_format_options(verb, options->format, {"text", "markdown", "json"}, "the description");
  verb.renamed("--markdown", "`describe --markdown` is now `describe --format markdown`");
  add_foreign_options(verb, options->foreign, true);
  verb.runs([options] { return describe(*options); });
}

}  // namespace scanbench::app
