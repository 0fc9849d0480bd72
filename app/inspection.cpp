// The verbs check, list and describe, which run and write nothing.
#include "app/inspection.hpp"

#include <fmt/format.h>

#include "app/inputs.hpp"
#include "harness/report/catalog.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/scenario/effective.hpp"

namespace scanbench::app {
namespace {

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
    if (scenario.pipelines.empty()) fmt::print("  note: no pipelines: for `simulate` and for suites, not for `run`\n");
    for (const auto& note : scenario.notes) fmt::print("  note: {}\n", note);
  }
  return kGood;
}

int list(const std::string& kind, bool json) {
  const auto entries = harness::catalog_of_kind(kind);
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

void add_inspection(Context& context) {
  struct Options {
    std::vector<std::string> files, sets;
    std::string name;
    bool effective = false, json = false, all = false, markdown = false;
  };
  auto options = std::make_shared<Options>();

  auto* check_verb = context.app.add_subcommand("check", "Checks scenario or suite files without running them");
  check_verb->add_option("FILE", options->files, "scenario or suite files")->required();
  check_verb->add_option("--set", options->sets, "KEY=VALUE: replaces a value of the file (dotted keys)")->take_all();
  check_verb->add_flag("--effective", options->effective, "print the scenario with every default filled in");
  check_verb->callback([&context, options] {
    context.action = [options] { return check(options->files, options->sets, options->effective); };
  });

  auto* list_verb = context.app.add_subcommand("list", "Lists modules, metrics, figures, trajectories and sensors");
  list_verb->add_option("KIND", options->name,
                        "only this kind: modules, extract, merge, metrics, figures, trajectories, sensors, ...");
  list_verb->add_flag("--json", options->json, "as JSON");
  list_verb->callback(
      [&context, options] { context.action = [options] { return list(options->name, options->json); }; });

  auto* describe_verb =
      context.app.add_subcommand("describe", "Shows what a module does, its parameters, defaults and bounds");
  describe_verb->add_option("NAME", options->name, "a name from `list`, or a metric, like f1");
  describe_verb->add_flag("--all", options->all, "describe everything");
  describe_verb->add_flag("--markdown", options->markdown,
                          "as Markdown (docs/modules.md is made with --all --markdown)");
  describe_verb->add_flag("--json", options->json, "as JSON");
  describe_verb->callback([&context, options] {
    context.action = [options] { return describe(options->name, options->all, options->markdown, options->json); };
  });
}

}  // namespace scanbench::app
